// SPDX-License-Identifier: BSD-3-Clause
#include "blob_finder.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "parley_geometry/angles.h"

namespace parley {
namespace {

/// A bin that was looked at.
struct Look {
  int bin = 0;
  double range = 0.0;  // [m] range_max if free
  bool hit = false;
  bool gap = false;  // too much unseen between it and the one before
};

using Looks = std::vector<Look>;

Looks looksOf(const BinnedScan& scan) {
  Looks looks;
  const auto bins = static_cast<int>(scan.ranges.size());
  for (int bin = 0; bin < bins; ++bin) {
    const auto i = static_cast<std::size_t>(bin);
    if (std::isnan(scan.ranges[i])) continue;
    const bool hit = scan.beams[i] >= 0;
    const int step = looks.empty() ? 1 : bin - looks.back().bin;
    looks.push_back({bin, hit ? static_cast<double>(scan.ranges[i]) : scan.range_max, hit, step > scan.beam_width + 1});
  }
  if (!looks.empty()) looks.front().gap = looks.front().bin + bins - looks.back().bin > scan.beam_width + 1;
  return looks;
}

bool isJoined(const Look& a, const Look& b, double jump) {
  return a.hit && b.hit && !b.gap && std::abs(a.range - b.range) <= jump;
}

int countBeams(const BinnedScan& scan, const Looks& group) {
  int count = 0, last = -1;
  for (const Look& look : group) {
    const int beam = scan.beams[static_cast<std::size_t>(look.bin)];
    count += beam != last ? 1 : 0;
    last = beam;
  }
  return count;
}

struct Extent {
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();

  void add(double value) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
  double size() const { return most - least; }
  double middle() const { return 0.5 * (least + most); }
};

/// Middle and size in the axes of the line of sight. Ahead the middle is the mean, to which faces seen at a shallow angle
/// add little: they come and go from scan to scan.
BlobShape shapeOf(const BinnedScan& scan, const Looks& group) {
  BlobShape shape;
  const BearingBins bins(static_cast<int>(scan.ranges.size()));
  const auto direction = [&](double bin) {
    const double bearing = -kPi + (bin + 0.5) * bins.width();
    return Eigen::Vector2d(std::cos(bearing), std::sin(bearing));
  };
  const int turn = group.back().bin < group.front().bin ? bins.count() : 0;
  const Eigen::Vector2d ahead = direction(0.5 * (group.front().bin + group.back().bin + turn));
  const Eigen::Vector2d aside(-ahead.y(), ahead.x());
  Extent along, across;
  double depth = 0.0;
  for (const Look& look : group) {
    const Eigen::Vector2d ray = look.range * direction(look.bin);
    along.add(ray.dot(ahead));
    depth += ray.dot(ahead) / static_cast<double>(group.size());
    across.add(ray.dot(aside));
    shape.points.push_back(scan.origin + ray);
  }
  shape.blob.position = scan.origin + depth * ahead + across.middle() * aside;
  // Each return stands for a beam's width.
  shape.blob.chord = across.size() + depth * scan.beam_width * bins.width();
  shape.blob.beams = countBeams(scan, group);
  shape.depth = along.size();
  for (const Eigen::Vector2d& point : shape.points) {
    shape.radius = std::max(shape.radius, (point - shape.blob.position).norm());
  }
  return shape;
}

bool hasBlobSize(const BlobShape& shape, const LidarOptions& options) {
  return shape.blob.beams >= options.blob_min_beams && shape.blob.chord >= options.blob_min_chord &&
         std::max(shape.blob.chord, shape.depth) <= options.blob_max_chord;
}

}  // namespace

std::vector<BlobShape> findBlobs(const BinnedScan& scan, const LidarOptions& options) {
  const Looks looks = looksOf(scan);
  const std::size_t count = looks.size();
  const auto at = [&](std::size_t i) -> const Look& { return looks[i % count]; };
  std::size_t start = 0;
  while (start < count && isJoined(at(start + count - 1), at(start), options.blob_jump)) ++start;
  std::vector<BlobShape> blobs;
  if (start == count) return blobs;  // nothing seen, or one surface all around
  for (std::size_t first = start; first < start + count;) {
    std::size_t last = first;
    while (last + 1 < start + count && isJoined(at(last), at(last + 1), options.blob_jump)) ++last;
    const Look &before = at(first + count - 1), &after = at(last + 1);
    const bool stands_off = at(first).hit && !at(first).gap && !after.gap && before.range > at(first).range + options.blob_jump &&
                            after.range > at(last).range + options.blob_jump;
    if (stands_off && static_cast<int>(last - first) + 1 >= options.blob_min_beams) {
      Looks group;
      for (std::size_t i = first; i <= last; ++i) group.push_back(at(i));
      const BlobShape shape = shapeOf(scan, group);
      if (hasBlobSize(shape, options)) blobs.push_back(shape);
    }
    first = last + 1;
  }
  return blobs;
}

}  // namespace parley

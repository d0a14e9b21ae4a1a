// SPDX-License-Identifier: BSD-3-Clause
#include "simulated_lidar.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace parley::test {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kJump = 0.25;        // [m] a blob stands off by this
constexpr double kLeastChord = 0.12;  // [m]
constexpr double kMostChord = 1.0;    // [m]
constexpr int kLeastBeams = 3;        // [-]

double segmentRange(const Eigen::Vector2d& from, const Eigen::Vector2d& direction, const WallSegment& wall) {
  const Eigen::Vector2d along = wall.b - wall.a, to = wall.a - from;
  const double denominator = direction.x() * along.y() - direction.y() * along.x();
  if (denominator == 0.0) return kInf;
  const double range = (to.x() * along.y() - to.y() * along.x()) / denominator;
  const double where = (to.x() * direction.y() - to.y() * direction.x()) / denominator;
  return range > 0.0 && where >= 0.0 && where <= 1.0 ? range : kInf;
}

/// Bins first to last are a blob if they stand off from what is beside them and have the size.
void addBlob(ObstacleScan& scan, int first, int last) {
  const int count = static_cast<int>(scan.binCount());
  const auto range = [&](int bin) {
    const double r = static_cast<double>(scan.ranges[static_cast<std::size_t>((bin + count) % count)]);
    return std::isnan(r) ? 0.0 : std::min(r, scan.range_max);
  };
  if (last - first + 1 < kLeastBeams) return;
  if (range(first - 1) <= range(first) + kJump || range(last + 1) <= range(last) + kJump) return;
  const double middle = 0.5 * (scan.bearingOf(0) * 2.0 + (first + last) * 2.0 * kPi / count);
  const Eigen::Vector2d ahead(std::cos(middle), std::sin(middle)), aside(-ahead.y(), ahead.x());
  double depth = 0.0, low = kInf, high = -kInf, near = kInf, far = -kInf;
  for (int bin = first; bin <= last; ++bin) {
    const Eigen::Vector2d ray = scan.pointAt(static_cast<std::size_t>((bin + count) % count), range(bin)) - scan.origin;
    depth += ray.dot(ahead) / (last - first + 1);
    low = std::min(low, ray.dot(aside));
    high = std::max(high, ray.dot(aside));
    near = std::min(near, ray.dot(ahead));
    far = std::max(far, ray.dot(ahead));
  }
  const double chord = high - low + depth * 2.0 * kPi / count;
  if (chord < kLeastChord || std::max(chord, far - near) > kMostChord) return;
  scan.blobs.push_back({scan.origin + depth * ahead + 0.5 * (low + high) * aside, chord, last - first + 1});
}

}  // namespace

double bodyRange(const Eigen::Vector2d& from, const Eigen::Vector2d& direction, const Polygon& outline) {
  double nearest = kInf;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    nearest = std::min(nearest, segmentRange(from, direction, {outline[i], outline[(i + 1) % outline.size()]}));
  }
  return nearest;
}

void findBlobs(ObstacleScan& scan) {
  const int count = static_cast<int>(scan.binCount());
  const auto range = [&](int bin) { return scan.ranges[static_cast<std::size_t>((bin + count) % count)]; };
  const auto joined = [&](int a, int b) {
    return std::isfinite(range(a)) && std::isfinite(range(b)) && std::abs(range(a) - range(b)) <= kJump;
  };
  int start = 0;
  while (start < count && joined(start - 1, start)) ++start;
  for (int first = start; first < start + count;) {
    int last = first;
    while (last + 1 < start + count && joined(last, last + 1)) ++last;
    if (std::isfinite(range(first))) addBlob(scan, first, last);
    first = last + 1;
  }
}

WallRange segmentWorld(std::vector<WallSegment> walls) {
  return [walls = std::move(walls)](const Eigen::Vector2d& from, const Eigen::Vector2d& direction, double) {
    double nearest = kInf;
    for (const WallSegment& wall : walls) nearest = std::min(nearest, segmentRange(from, direction, wall));
    return nearest;
  };
}

std::vector<WallSegment> box(const Eigen::Vector2d& low, const Eigen::Vector2d& high) {
  const Eigen::Vector2d right_low(high.x(), low.y()), left_high(low.x(), high.y());
  return {{low, right_low}, {right_low, high}, {high, left_high}, {left_high, low}};
}

std::vector<WallSegment> operator+(std::vector<WallSegment> a, const std::vector<WallSegment>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

std::vector<WallSegment> distinctiveRoom() {
  return box({0.0, 0.0}, {9.0, 6.0}) + box({1.0, 4.9}, {2.2, 6.0}) + box({6.9, 0.0}, {7.4, 1.3}) + box({4.2, 5.5}, {5.4, 6.0}) +
         box({0.0, 2.1}, {0.4, 2.9}) + std::vector<WallSegment>{{{8.0, 6.0}, {9.0, 4.6}}, {{3.0, 0.0}, {3.4, 0.9}}};
}

ObstacleScan simulatedScan(const WallRange& walls, const std::vector<Body>& bodies, const Pose2& T_world_base, double stamp,
                           const LidarModel& lidar, std::mt19937& random) {
  ObstacleScan scan;
  scan.stamp = stamp;
  scan.range_max = lidar.range;
  scan.ranges.assign(static_cast<std::size_t>(lidar.beams), static_cast<float>(kInf));
  scan.transient.assign(scan.ranges.size(), false);
  std::normal_distribution<double> noise(0.0, 1.0);
  std::vector<Polygon> outlines;
  for (const Body& body : bodies) outlines.push_back(body.footprint.polygonAt(body.T_world_body));
  for (std::size_t bin = 0; bin < scan.ranges.size(); ++bin) {
    const double bearing = T_world_base.yaw + scan.bearingOf(bin);
    const Eigen::Vector2d direction(std::cos(bearing), std::sin(bearing)), from = T_world_base.position();
    double range = walls(from, direction, lidar.range);
    for (std::size_t i = 0; i < outlines.size(); ++i) {
      const double to_body = bodyRange(from, direction, outlines[i]);
      if (to_body >= range) continue;
      range = to_body;
      scan.transient[bin] = bodies[i].moving;
    }
    range += lidar.noise * noise(random);
    if (range > lidar.range) {
      scan.transient[bin] = false;
    } else {
      scan.ranges[bin] = static_cast<float>(std::max(range, 0.02));
    }
  }
  findBlobs(scan);
  return scan;
}

}  // namespace parley::test

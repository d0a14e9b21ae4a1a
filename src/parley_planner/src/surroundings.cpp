// SPDX-License-Identifier: BSD-3-Clause
#include "surroundings.h"

#include <algorithm>
#include <cmath>

namespace parley {

namespace {

using Mask = std::vector<unsigned char>;

constexpr double kTrackGrowth = 0.15;  // [m] returns this far outside a tracked thing still belong to it

bool isOnMovingTrack(const Eigen::Vector2d& p_odom, const std::vector<TrackedObject>& tracks) {
  return std::any_of(tracks.begin(), tracks.end(), [&](const TrackedObject& track) {
    return track.moving && (p_odom - track.position).norm() < track.radius + kTrackGrowth;
  });
}

Mask obstacleMask(const LocalMap& map, const ObstacleScan& scan, const Pose2& T_odom_scan,
                  const std::vector<TrackedObject>& tracks) {
  Mask mask(map.cells.size());
  std::transform(map.cells.begin(), map.cells.end(), mask.begin(),
                 [](CellState state) { return static_cast<unsigned char>(state == CellState::kOccupied); });
  for (std::size_t bin = 0; bin < scan.binCount(); ++bin) {
    if (!std::isfinite(scan.ranges[bin])) continue;
    const Eigen::Vector2d p_odom = T_odom_scan * scan.pointAt(bin, static_cast<double>(scan.ranges[bin]));
    const Eigen::Vector2i cell = map.frame.cellOf(p_odom);
    if (!map.frame.contains(cell) || isOnMovingTrack(p_odom, tracks)) continue;
    mask[static_cast<std::size_t>(map.frame.indexOf(cell))] = 1;
  }
  return mask;
}

/// Unknown cells, but for specks: rays leave single cells out far away, and nothing that the lidar misses fits in one.
Mask unseenMask(const LocalMap& map) {
  Mask mask(map.cells.size());
  const int w = map.frame.width, h = map.frame.height;
  const auto unknown = [&](int x, int y) {
    return map.cells[static_cast<std::size_t>(y * w + x)] == CellState::kUnknown ? 1 : 0;
  };
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      if (!unknown(x, y)) continue;
      const bool rim = x == 0 || y == 0 || x == w - 1 || y == h - 1;
      mask[static_cast<std::size_t>(y * w + x)] =
          rim || unknown(x - 1, y) + unknown(x + 1, y) + unknown(x, y - 1) + unknown(x, y + 1) > 1;
    }
  }
  return mask;
}

/// Marks the cells whose centres are in a part of the plane that lies in the square of `reach` [m] around `center`.
template <class Contains>
void mark(const GridFrame& frame, const Eigen::Vector2d& center, double reach, const Contains& contains, Mask& mask) {
  const Eigen::Vector2i last(frame.width - 1, frame.height - 1);
  const Eigen::Vector2i low = frame.cellOf(center - Eigen::Vector2d::Constant(reach)).cwiseMax(0);
  const Eigen::Vector2i high = frame.cellOf(center + Eigen::Vector2d::Constant(reach)).cwiseMin(last);
  for (int y = low.y(); y <= high.y(); ++y) {
    for (int x = low.x(); x <= high.x(); ++x) {
      if (contains(frame.centerOf({x, y}))) mask[static_cast<std::size_t>(frame.indexOf({x, y}))] = 1;
    }
  }
}

}  // namespace

void Blocked::addStrip(const std::vector<Eigen::Vector2d>& middle, double half_width) {
  for (const Eigen::Vector2d& p : middle) discs.push_back({p, half_width});
}

Surroundings::Surroundings(const LocalMap& map, const ObstacleScan& scan, const Pose2& T_odom_scan,
                           const std::vector<TrackedObject>& tracks)
    : mask_(obstacleMask(map, scan, T_odom_scan, tracks)), obstacles_(map.frame, mask_), unseen_(map.frame, unseenMask(map)) {}

Surroundings Surroundings::with(const Blocked& blocked) const {
  Surroundings result = *this;
  for (const auto& [center, radius] : blocked.discs) {
    const double most = radius * radius;
    const auto contains = [c = center, most](const Eigen::Vector2d& p) { return (c - p).squaredNorm() < most; };
    mark(frame(), center, radius, contains, result.mask_);
  }
  for (const Blocked::Body& body : blocked.bodies) {
    const Pose2 T_body_odom = body.pose.inverse();
    const auto contains = [&](const Eigen::Vector2d& p) { return body.footprint.contains(T_body_odom * p, body.growth); };
    const double reach = body.footprint.circumscribedRadius() + std::sqrt(2.0) * body.growth;
    mark(frame(), body.pose.position(), reach, contains, result.mask_);
  }
  result.obstacles_ = DistanceField(frame(), result.mask_);
  return result;
}

FootprintProbe::FootprintProbe(const Footprint& footprint) : footprint_(footprint) {
  const double half_long = 0.5 * std::max(footprint.length, footprint.width);
  const double half_short = 0.5 * std::min(footprint.length, footprint.width);
  const bool along_x = footprint.length >= footprint.width;
  const auto add = [&](double along, double across, double radius) {
    points_.push_back({along_x ? Eigen::Vector2d(along, across) : Eigen::Vector2d(across, along), radius});
  };
  // Discs as wide as the footprint along its axis, and its ends' rims, where the discs leave the corners out.
  const double reach = half_long - half_short;
  const int discs = 1 + 2 * static_cast<int>(std::ceil(reach / (0.5 * half_short)));
  for (int i = 0; i < discs; ++i) {
    add(discs > 1 ? reach * (2.0 * i / (discs - 1) - 1.0) : 0.0, 0.0, half_short);
  }
  for (const double end : {-half_long, half_long}) {
    for (const double across : {-1.0, -0.5, 0.5, 1.0}) add(end, across * half_short, 0.0);
    const double near_end = end > 0.0 ? end - 0.5 * half_short : end + 0.5 * half_short;
    for (const double across : {-1.0, 1.0}) add(near_end, across * half_short, 0.0);
  }
}

double FootprintProbe::clearance(const DistanceField& field, const Pose2& pose) const {
  const double c = std::cos(pose.yaw), s = std::sin(pose.yaw);
  double least = 1e3;
  for (const Point& point : points_) {
    const Eigen::Vector2d p(pose.x + c * point.p_base.x() - s * point.p_base.y(),
                            pose.y + s * point.p_base.x() + c * point.p_base.y());
    least = std::min(least, field.at(p) - point.radius);
  }
  return least;
}

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "parley_geometry/angles.h"
#include "parley_geometry/pose2.h"

namespace parley {

/// A planar lidar's reading as the driver gives it, by REP-117: +inf no return, -inf too close, NaN invalid.
struct RangeScan {
  double stamp = 0.0;            // [s] of the first beam, robot's clock
  double angle_min = 0.0;        // [rad] of the first beam in the lidar frame
  double angle_increment = 0.0;  // [rad] counter-clockwise positive
  double time_increment = 0.0;   // [s] between beams
  double range_min = 0.0;        // [m]
  double range_max = 0.0;        // [m]
  std::vector<float> ranges;     // [m]
};

/// One return of a spatial lidar, in the lidar frame.
struct LidarPoint {
  float x = 0.0F;     // [m]
  float y = 0.0F;     // [m]
  float z = 0.0F;     // [m]
  float time = 0.0F;  // [s] after the cloud's stamp
};

/// A spatial lidar's returns over one turn; rays without a return are not in it.
struct LidarCloud {
  double stamp = 0.0;  // [s] of the first point, robot's clock
  std::vector<LidarPoint> points;
};

/// Something narrow that stands off from what is behind it: could be a robot.
struct Blob {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // [m] middle of what is seen, base frame
  double chord = 0.0;                                  // [m] width across the line of sight
  int beams = 0;                                       // [-] bearing bins that saw it
};

/// Lidar stage's result: the nearest obstacle in each direction, cleaned, levelled, de-skewed, in the base frame at `stamp`.
struct ObstacleScan {
  double stamp = 0.0;                                // [s] the time at which base frame the scan is given
  double range_max = 0.0;                            // [m] how far the lidar sees
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();  // [m] of the lidar, base frame
  /// Per bearing bin, counter-clockwise from -pi about `origin`, axes of the base frame: [m] range of the nearest
  /// obstacle, +inf free up to range_max, NaN not looked at.
  std::vector<float> ranges;
  std::vector<Eigen::Vector2f> points;  // [m] obstacle points after the voxel grid, base frame
  std::vector<Blob> blobs;
  /// Per bin, true where the return is on something that moves or may move, or a known teammate: it blocks now but is not of
  /// the map.
  std::vector<bool> transient;
  /// Per bin, true where the return is on the very thing that is seen to move, or on a known teammate.
  std::vector<bool> moving;

  std::size_t binCount() const { return ranges.size(); }
  double bearingOf(std::size_t bin) const {
    return -kPi + (static_cast<double>(bin) + 0.5) * 2.0 * kPi / static_cast<double>(ranges.size());
  }
  /// The end of a bin's ray at `range`, base frame.
  Eigen::Vector2d pointAt(std::size_t bin, double range) const {
    const double bearing = bearingOf(bin);
    return origin + range * Eigen::Vector2d(std::cos(bearing), std::sin(bearing));
  }
};

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <optional>
#include <vector>

#include "parley_geometry/odometry_buffer.h"
#include "parley_lidar/lidar_options.h"

namespace parley {

/// Maps lidar coordinates into the levelled base frame at the end of the scan.
struct LidarToBase {
  Eigen::Matrix3f rotation = Eigen::Matrix3f::Identity();
  Eigen::Vector3f translation = Eigen::Vector3f::Zero();

  Eigen::Vector3f operator*(const Eigen::Vector3f& p_lidar) const { return rotation * p_lidar + translation; }
};

/// How the lidar moved while it scanned, cut into slices of a millisecond: 2 mm at 2 m/s.
class ScanMotion {
 public:
  /// nullopt if odometry does not cover [start, start + duration].
  static std::optional<ScanMotion> over(const OdometryBuffer& odometry, double start, double duration, const LidarMount& mount);

  /// time: [s] after the start, within the duration.
  const LidarToBase& at(float time) const {
    return slices_[std::min(static_cast<std::size_t>(time * slices_per_second_), slices_.size() - 1)];
  }
  const Odometry& end() const { return end_; }
  /// Of the lidar, base frame at the end.
  const Eigen::Vector2d& origin() const { return origin_; }
  /// How far the lidar moved from first to last beam. [m]
  double travel() const { return travel_; }
  /// One slice, no tilt: bearings and ranges need no correction.
  bool isStill() const { return slices_.size() == 1 && end_.roll == 0.0 && end_.pitch == 0.0; }

 private:
  Odometry end_;
  Eigen::Vector2d origin_ = Eigen::Vector2d::Zero();
  double travel_ = 0.0;
  float slices_per_second_ = 0.0F;
  std::vector<LidarToBase> slices_;
};

}  // namespace parley

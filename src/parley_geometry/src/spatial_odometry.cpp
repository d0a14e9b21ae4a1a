// SPDX-License-Identifier: BSD-3-Clause
#include "parley_geometry/spatial_odometry.h"

#include <algorithm>
#include <cmath>

namespace parley {
namespace {

constexpr double kTimeReset = 1.0;  // [s] going back by more means that time started again

}  // namespace

std::optional<Odometry> SpatialOdometry::add(double stamp, const Eigen::Isometry3d& T_start_sensor) {
  const bool back = last_ && stamp < *last_ - kTimeReset;
  if (!std::isfinite(stamp) || !T_start_sensor.matrix().allFinite() || (last_ && stamp <= *last_ && !back)) {
    ++dropped_;
    return std::nullopt;
  }
  if (back) twist_.reset();
  last_ = stamp;
  const Eigen::Isometry3d T_odom_base = T_base_sensor_ * T_start_sensor * T_sensor_base_;
  const Eigen::Matrix3d r = T_odom_base.linear();
  Odometry odometry;
  odometry.stamp = stamp;
  odometry.pose = {T_odom_base.translation().x(), T_odom_base.translation().y(), std::atan2(r(1, 0), r(0, 0))};
  odometry.roll = std::atan2(r(2, 1), r(2, 2));
  odometry.pitch = std::asin(std::clamp(-r(2, 0), -1.0, 1.0));
  const std::optional<Twist2> twist = twist_.add(stamp, odometry.pose);
  if (!twist) return std::nullopt;
  odometry.twist = *twist;
  return odometry;
}

}  // namespace parley

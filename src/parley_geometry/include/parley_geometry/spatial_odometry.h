// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "parley_geometry/motion.h"
#include "parley_geometry/twist_estimator.h"

namespace parley {

/// Planar odometry of base_link, with a twist, from the poses of a sensor in space, as lidar odometry has them: without a
/// twist, in a frame that begins where the sensor was. T_odom_base = T_base_sensor T_start_sensor T_sensor_base, so that odom
/// begins where the robot stood: on a level floor it is level, however the sensor is mounted.
class SpatialOdometry {
 public:
  SpatialOdometry(const Eigen::Isometry3d& T_base_sensor, const TwistOptions& options, const MotionLimits& limits)
      : T_base_sensor_(T_base_sensor), T_sensor_base_(T_base_sensor.inverse()), twist_(options, limits) {}

  /// nullopt where the pose is not finite or not newer than the last one by less than a second (`dropped` counts these), and
  /// for the first pose, after a gap and where time went back, since the velocity is not known.
  std::optional<Odometry> add(double stamp, const Eigen::Isometry3d& T_start_sensor);

  int dropped() const { return dropped_; }
  int corrections() const { return twist_.corrections(); }

 private:
  Eigen::Isometry3d T_base_sensor_;
  Eigen::Isometry3d T_sensor_base_;
  TwistEstimator twist_;
  std::optional<double> last_;  // [s]
  int dropped_ = 0;             // [-]
};

}  // namespace parley

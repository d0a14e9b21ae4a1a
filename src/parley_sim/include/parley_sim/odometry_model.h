// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "parley_geometry/motion.h"
#include "parley_sim/attitude.h"
#include "parley_sim/drive_model.h"
#include "parley_sim/random_stream.h"
#include "parley_sim/scenario.h"

namespace parley::sim {

/// Odometry that drifts as it goes, in the robot's own frame, which starts where the robot starts.
class OdometryModel {
 public:
  /// `attitude_noise`: of roll and pitch, 0 for odometry that is planar. [rad]
  OdometryModel(const OdometrySpec& spec, double attitude_noise, RandomStream stream);

  /// Takes note of the true motion between two physics steps.
  void advance(const Pose2& from, const Pose2& to, const Twist2& twist, double dt);

  /// T_odom_base as odometry believes it to be.
  const Pose2& pose() const { return pose_; }

  Odometry reading(double stamp, const Twist2& twist, const Attitude::Angles& attitude);

 private:
  OdometrySpec spec_;
  double attitude_noise_;
  RandomStream stream_;
  Pose2 pose_;
};

}  // namespace parley::sim

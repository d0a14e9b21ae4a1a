// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "parley_control/control_options.h"
#include "parley_geometry/trajectory.h"

namespace parley {

/// Hardest braking. It keeps to the path of a trajectory, which was planned around the obstacles, or without one to the
/// curvature it started with. The turn rate falls with the speed, never faster than it can; at rest both are exactly
/// zero.
class Braking {
 public:
  explicit Braking(const MotionLimits& limits) : limits_(limits) {}
  /// `path_time` [s] is that of the trajectory's state nearest to the robot. The trajectory must outlive this.
  Braking(const MotionLimits& limits, const SampledTrajectory& trajectory, double path_time)
      : limits_(limits), trajectory_(&trajectory), path_time_(path_time) {}

  /// The twist `dt` seconds after `from`.
  Twist2 next(const Twist2& from, double dt);

 private:
  MotionLimits limits_;
  const SampledTrajectory* trajectory_ = nullptr;
  double path_time_ = 0.0;  // [s]
};

/// The time of the state of a trajectory that is nearest to `T_odom_base`, for a robot that has fallen behind it. [s]
double pathTime(const SampledTrajectory& trajectory, const Pose2& T_odom_base, double now);

/// What a robot does and is about to do.
struct Motion {
  Twist2 measured;
  Twist2 commanded;  // last, perhaps not yet taken up
  Twist2 intended;   // a reaction time later, if nothing comes in between
};

/// Poses in the present base frame, a few centimetres apart, of a robot that takes up what was commanded, goes on towards
/// what is intended until `reaction_time` [s] has passed and then brakes until it stands. Empty if it stands and means to.
std::vector<Pose2> brakingSweep(const Motion& motion, Braking braking, double reaction_time, const ControlOptions& options,
                                const MotionLimits& limits);

/// The limits that the last-moment stop counts on.
MotionLimits brakingLimits(const MotionLimits& limits, const ControlOptions& options);

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "parley_control/control_options.h"
#include "parley_geometry/trajectory.h"

namespace parley {

/// Where the robot should be and how to get there.
struct Tracking {
  Twist2 desired;                 // feed-forward and feedback, within the highest speed and turn rate
  Twist2 intended;                // what it will be after the reaction time, if nothing comes in between
  Pose2 error;                    // reference pose now, in the base frame: ahead, left, counter-clockwise
  bool reference_stands = false;  // now and after the look-ahead
};

/// The twist that brings a robot at `T_odom_base` onto a trajectory, which must not be empty, and along it.
Tracking track(const SampledTrajectory& trajectory, const Pose2& T_odom_base, double now, const ControlOptions& options,
               const MotionLimits& limits);

}  // namespace parley

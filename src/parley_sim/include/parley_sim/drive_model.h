// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "parley_geometry/motion.h"
#include "parley_geometry/pose2.h"

namespace parley::sim {

/// Where a body truly is and how it moves, in the world frame.
struct BodyState {
  Pose2 pose;
  Twist2 twist;
};

/// The body `dt` seconds later, its wheels following `command` as fast as the limits allow. Both ways of driving and
/// braking have the same limits; what is not finite counts as a command to stand.
BodyState driven(const BodyState& body, const Twist2& command, const MotionLimits& limits, double dt);

/// How far a body needs to stop from its present speed, its reaction included. [m]
double brakingDistance(const BodyState& body, const MotionLimits& limits);

}  // namespace parley::sim

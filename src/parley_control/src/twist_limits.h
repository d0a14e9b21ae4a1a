// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "parley_geometry/motion.h"

namespace parley {

/// `to`, or as far towards it as `step` allows.
double approach(double from, double to, double step);

/// The twist nearest to `wanted` that a drive can have `dt` seconds after `from`.
Twist2 limited(const Twist2& from, const Twist2& wanted, const MotionLimits& limits, double dt);

/// Within the highest speed and turn rate; too high a turn rate lowers the speed as well, so that the curvature stays.
Twist2 keepingCurvature(const Twist2& twist, const MotionLimits& limits);

bool isFinite(const Twist2& twist);

}  // namespace parley

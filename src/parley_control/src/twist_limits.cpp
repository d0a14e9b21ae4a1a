// SPDX-License-Identifier: BSD-3-Clause
#include "twist_limits.h"

#include <algorithm>
#include <cmath>

namespace parley {

double approach(double from, double to, double step) { return std::clamp(to, from - step, from + step); }

Twist2 limited(const Twist2& from, const Twist2& wanted, const MotionLimits& limits, double dt) {
  return {
      approach(from.speed, std::clamp(wanted.speed, -limits.speed, limits.speed), limits.acceleration * dt),
      approach(from.turn_rate, std::clamp(wanted.turn_rate, -limits.turn_rate, limits.turn_rate), limits.turn_acceleration * dt)};
}

Twist2 keepingCurvature(const Twist2& twist, const MotionLimits& limits) {
  const double excess = std::abs(twist.turn_rate) / limits.turn_rate;
  const double speed = excess > 1.0 ? twist.speed / excess : twist.speed;
  return {std::clamp(speed, -limits.speed, limits.speed), std::clamp(twist.turn_rate, -limits.turn_rate, limits.turn_rate)};
}

bool isFinite(const Twist2& twist) { return std::isfinite(twist.speed) && std::isfinite(twist.turn_rate); }

}  // namespace parley

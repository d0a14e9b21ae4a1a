// SPDX-License-Identifier: BSD-3-Clause
#include "parley_sim/drive_model.h"

#include <algorithm>
#include <cmath>

namespace parley::sim {
namespace {

constexpr double kReaction = 0.3;  // [s] from a new obstacle to the brakes: a scan, a plan
constexpr double kMargin = 0.2;    // [m]

double approached(double from, double to, double limit, double change) {
  const double target = std::isfinite(to) ? std::clamp(to, -limit, limit) : 0.0;
  return std::clamp(target, from - change, from + change);
}

}  // namespace

BodyState driven(const BodyState& body, const Twist2& command, const MotionLimits& limits, double dt) {
  BodyState next;
  next.twist.speed = approached(body.twist.speed, command.speed, limits.speed, limits.acceleration * dt);
  next.twist.turn_rate = approached(body.twist.turn_rate, command.turn_rate, limits.turn_rate, limits.turn_acceleration * dt);
  next.pose = integrateTwist(body.pose, 0.5 * (body.twist.speed + next.twist.speed),
                             0.5 * (body.twist.turn_rate + next.twist.turn_rate), dt);
  return next;
}

double brakingDistance(const BodyState& body, const MotionLimits& limits) {
  const double speed = std::abs(body.twist.speed);
  return speed * kReaction + 0.5 * speed * speed / limits.acceleration + kMargin;
}

}  // namespace parley::sim

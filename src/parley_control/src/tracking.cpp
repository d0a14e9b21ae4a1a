// SPDX-License-Identifier: BSD-3-Clause
#include "tracking.h"

#include <algorithm>
#include <cmath>

#include "twist_limits.h"

namespace parley {
namespace {

bool stands(const Twist2& twist) {
  constexpr double kStanding = 1e-3;  // [m/s, rad/s] what an optimiser leaves where it means zero
  return std::abs(twist.speed) < kStanding && std::abs(twist.turn_rate) < kStanding;
}

/// sin(x) / x.
double sinc(double x) { return std::abs(x) < 1e-6 ? 1.0 : std::sin(x) / x; }

/// With a small heading error the distance beside the path obeys e'' + 2 d sqrt(c) |v| e' + c v^2 e = 0: the same path
/// back at any speed, forwards and backwards. At v = 0 only the distance ahead and the heading are corrected.
Twist2 feedback(const Pose2& error, double speed, const ControlOptions& o) {
  const double heading_gain = o.heading_gain + 2.0 * o.damping * std::sqrt(o.cross_gain) * std::abs(speed);
  const double turn_rate = heading_gain * error.yaw + o.cross_gain * speed * sinc(error.yaw) * error.y;
  return {std::clamp(o.along_gain * error.x, -o.correction_speed, o.correction_speed),
          std::clamp(turn_rate, -o.correction_turn_rate, o.correction_turn_rate)};
}

}  // namespace

Tracking track(const SampledTrajectory& trajectory, const Pose2& T_odom_base, double now, const ControlOptions& options,
               const MotionLimits& limits) {
  const TrajectoryPoint reference = trajectory.at(now);
  const Twist2 ahead = trajectory.at(now + options.look_ahead).twist;
  const Twist2 later = trajectory.at(now + options.look_ahead + options.reaction_time).twist;

  Tracking tracking;
  tracking.error = T_odom_base.inverse() * reference.pose;
  const Twist2 correction = feedback(tracking.error, ahead.speed, options);
  const Twist2 wanted{ahead.speed * std::cos(tracking.error.yaw) + correction.speed, ahead.turn_rate + correction.turn_rate};
  tracking.desired = keepingCurvature(wanted, limits);
  tracking.intended = {tracking.desired.speed + later.speed - ahead.speed,
                       tracking.desired.turn_rate + later.turn_rate - ahead.turn_rate};
  tracking.reference_stands = stands(reference.twist) && stands(ahead);
  return tracking;
}

}  // namespace parley

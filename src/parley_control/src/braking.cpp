// SPDX-License-Identifier: BSD-3-Clause
#include "braking.h"

#include <algorithm>
#include <cmath>

#include "twist_limits.h"

namespace parley {
namespace {

constexpr double kSpacing = 0.06;     // [m] between poses at most: what a corner cuts off between them is 2 mm
constexpr double kArm = 0.5;          // [m] at which turning counts as moving
constexpr double kMostPoses = 48.0;   // [-] of each phase
constexpr double kPlausible = 1.5;    // [-] times its limits, a measured twist is believed
constexpr double kSlow = 0.05;        // [m/s] below this a reference's curvature says nothing,
constexpr double kSlowShare = 0.5;    // [-] nor below this part of the robot's own speed: it is not following it
constexpr double kSearchStep = 0.05;  // [s]
constexpr int kSearchSteps = 60;      // [-] a robot that brakes is never further behind

/// Adds the poses of a motion that starts with a twist and goes on by `next(twist, dt)`; its last twist.
template <class Next>
Twist2 append(std::vector<Pose2>& poses, Twist2 twist, double duration, const Next& next) {
  if (duration <= 0.0) return twist;
  const double fast = std::abs(twist.speed) + kArm * std::abs(twist.turn_rate);
  const int steps = static_cast<int>(std::clamp(std::ceil(fast * duration / kSpacing), 1.0, kMostPoses));
  const double dt = duration / steps;
  for (int i = 0; i < steps; ++i) {
    const Twist2 after = next(twist, dt);
    poses.push_back(
        integrateTwist(poses.back(), 0.5 * (twist.speed + after.speed), 0.5 * (twist.turn_rate + after.turn_rate), dt));
    twist = after;
  }
  return twist;
}

Twist2 plausible(const Twist2& measured, const MotionLimits& limits) {
  const double speed = kPlausible * limits.speed, turn_rate = kPlausible * limits.turn_rate;
  return {std::clamp(measured.speed, -speed, speed), std::clamp(measured.turn_rate, -turn_rate, turn_rate)};
}

/// How long the drive needs to change its twist. [s]
double timeBetween(const Twist2& from, const Twist2& to, const MotionLimits& limits) {
  return std::max(std::abs(to.speed - from.speed) / limits.acceleration,
                  std::abs(to.turn_rate - from.turn_rate) / limits.turn_acceleration);
}

bool isZero(const Twist2& twist) { return twist.speed == 0.0 && twist.turn_rate == 0.0; }

}  // namespace

Twist2 Braking::next(const Twist2& from, double dt) {
  const double speed = approach(from.speed, 0.0, limits_.acceleration * dt);
  double curvature = from.speed != 0.0 ? from.turn_rate / from.speed : 0.0;
  if (trajectory_ != nullptr) {
    const Twist2 reference = trajectory_->at(path_time_).twist;
    const double slow = std::max(kSlow, kSlowShare * std::abs(from.speed));
    if (std::abs(reference.speed) > slow && reference.speed * from.speed > 0.0) {
      curvature = reference.turn_rate / reference.speed;
      path_time_ += dt * 0.5 * (from.speed + speed) / reference.speed;
    }
  }
  const double turn_rate = speed == 0.0 ? 0.0 : std::clamp(curvature * speed, -limits_.turn_rate, limits_.turn_rate);
  return {speed, approach(from.turn_rate, turn_rate, limits_.turn_acceleration * dt)};
}

double pathTime(const SampledTrajectory& trajectory, const Pose2& T_odom_base, double now) {
  const auto distance2 = [&](double time) {
    return (trajectory.at(time).pose.position() - T_odom_base.position()).squaredNorm();
  };
  double best = std::clamp(now, trajectory.startTime(), trajectory.endTime());
  double nearest = distance2(best);
  for (int i = 0; i < kSearchSteps && best > trajectory.startTime(); ++i) {
    const double earlier = std::max(trajectory.startTime(), best - kSearchStep);
    const double distance = distance2(earlier);
    if (!(distance < nearest)) break;
    best = earlier;
    nearest = distance;
  }
  return best;
}

std::vector<Pose2> brakingSweep(const Motion& motion, Braking braking, double reaction_time, const ControlOptions& options,
                                const MotionLimits& limits) {
  const bool stands = std::abs(motion.measured.speed) < options.standing_speed &&
                      std::abs(motion.measured.turn_rate) < options.standing_turn_rate;
  if (stands && isZero(motion.intended) && isZero(motion.commanded)) return {};
  std::vector<Pose2> poses{Pose2{}};
  Twist2 twist = stands ? Twist2{} : plausible(motion.measured, limits);
  const double delay = std::max(0.0, options.look_ahead - 0.5 * options.period);  // of the drive
  const double lag = std::max(delay, std::min(options.reaction_time, timeBetween(twist, motion.commanded, limits)));
  twist = append(poses, twist, lag, [&](const Twist2& t, double dt) { return limited(t, motion.commanded, limits, dt); });
  const double rest = std::max(0.0, reaction_time - lag);
  twist = append(poses, twist, rest, [&](const Twist2& t, double dt) { return limited(t, motion.intended, limits, dt); });
  const double duration = timeBetween(twist, {}, brakingLimits(limits, options));
  append(poses, twist, duration, [&](const Twist2& t, double dt) { return braking.next(t, dt); });
  return poses;
}

MotionLimits brakingLimits(const MotionLimits& limits, const ControlOptions& options) {
  MotionLimits braking = limits;
  braking.acceleration *= options.braking_share;
  braking.turn_acceleration *= options.braking_share;
  return braking;
}

}  // namespace parley

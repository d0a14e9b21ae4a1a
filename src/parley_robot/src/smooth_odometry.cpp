// SPDX-License-Identifier: BSD-3-Clause
#include "parley_robot/smooth_odometry.h"

#include <algorithm>
#include <cmath>

namespace parley {
namespace {

constexpr double kTimeReset = 1.0;   // [s] going back by more means that time started again
constexpr double kLongestGap = 0.3;  // [s] too much may have happened in a longer one

bool isFinite(const Odometry& o) {
  return std::isfinite(o.stamp) && o.pose.isFinite() && std::isfinite(o.twist.speed) && std::isfinite(o.twist.turn_rate);
}

Twist2 twistBetween(const Pose2& from, const Pose2& to, double dt) {
  const Pose2 step = from.inverse() * to;
  return {std::copysign(step.position().norm(), step.x) / dt, step.yaw / dt};
}

double limited(double value, double around, double most) { return std::clamp(value, around - most, around + most); }

}  // namespace

/// Whether a robot expected at one place can be at the other, by the limits and by what odometry is off.
bool SmoothOdometry::agree(const Pose2& expected, const Pose2& pose, double dt) const {
  const Pose2 off = expected.inverse() * pose;
  return off.position().norm() <= options_.distance + 0.5 * limits_.acceleration * dt * dt &&
         std::abs(off.yaw) <= options_.angle + 0.5 * limits_.turn_acceleration * dt * dt;
}

/// Where the robot would be if it had only gone on; nullopt if the pose can follow from the last reading.
std::optional<Pose2> SmoothOdometry::unlessExplained(const Pose2& pose, double dt) const {
  const Pose2 by_twist = integrateTwist(last_->pose, last_->twist.speed, last_->twist.turn_rate, dt);
  const Pose2 by_step = integrateTwist(last_->pose, last_step_.speed, last_step_.turn_rate, dt);
  if (agree(by_twist, pose, dt) || agree(by_step, pose, dt)) return std::nullopt;
  // Of odometry without a twist the step is right, otherwise the twist, which is quieter.
  return agree(by_twist, by_step, dt) ? by_twist : by_step;
}

Odometry SmoothOdometry::add(const Odometry& reading) {
  Odometry local = reading;
  if (corrections_ > 0) local.pose = T_odom_local_.inverse() * reading.pose;
  const double dt = last_ ? reading.stamp - last_->stamp : kLongestGap;
  if (!isFinite(reading) || (dt <= 0.0 && dt >= -kTimeReset)) return local;
  if (!last_ || dt < 0.0 || dt > kLongestGap) {
    last_ = local;
    last_step_ = local.twist;
    return local;
  }
  const Pose2 step = last_->pose.inverse() * local.pose;
  const bool jumps = step.position().norm() > options_.jump_distance || std::abs(step.yaw) > options_.jump_angle;
  const std::optional<Pose2> expected = jumps ? std::nullopt : unlessExplained(local.pose, dt);
  if (expected) {
    ++corrections_;
    local.pose = *expected;
    T_odom_local_ = reading.pose * expected->inverse();
    // The velocity of poses that were corrected may have the correction in it.
    local.twist.speed = limited(local.twist.speed, last_->twist.speed, limits_.acceleration * dt);
    local.twist.turn_rate = limited(local.twist.turn_rate, last_->twist.turn_rate, limits_.turn_acceleration * dt);
  }
  last_step_ = jumps ? local.twist : twistBetween(last_->pose, local.pose, dt);
  last_ = local;
  return local;
}

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#include "parley_robot/goal_tracker.h"

#include <cmath>

namespace parley {
namespace {

constexpr double kStandingSpeed = 0.02;     // [m/s]
constexpr double kStandingTurnRate = 0.02;  // [rad/s]

}  // namespace

bool GoalTracker::set(const Eigen::Vector2d& goal_odom) {
  if (!goal_odom.allFinite()) return false;
  goal_ = goal_odom;
  arrived_ = false;
  return true;
}

bool GoalTracker::update(const Odometry& odometry) {
  if (!goal_) return arrived_ = false;
  const double distance = (*goal_ - odometry.pose.position()).norm();
  const bool standing = std::abs(odometry.twist.speed) < kStandingSpeed && std::abs(odometry.twist.turn_rate) < kStandingTurnRate;
  if (arrived_) {
    arrived_ = distance <= tolerance_ + hysteresis_;
  } else {
    arrived_ = standing && distance <= tolerance_;
  }
  return arrived_;
}

}  // namespace parley

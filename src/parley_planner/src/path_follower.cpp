// SPDX-License-Identifier: BSD-3-Clause
#include "path_follower.h"

#include <algorithm>
#include <cmath>

namespace parley {

namespace {

// Tracking error obeys e'' + 2 zeta w e' + w^2 e = 0 over the distance driven.
constexpr double kStiffness = 5.0;     // [1/m^2] w^2
constexpr double kDamping = 4.5;       // [1/m] 2 zeta w
constexpr double kProjectReach = 0.4;  // [m] the projection moves at most this far at once

double approach(double from, double to, double step) { return std::clamp(to, from - step, from + step); }

/// The state that is advanced: pose of the motion (turned by pi when reversing) and motion along it.
struct Motion {
  Pose2 pose;
  double speed = 0.0;      // [m/s] along the motion
  double turn_rate = 0.0;  // [rad/s]
  double s = 0.0;          // [m]
};

double wantedCurvature(const ReferencePath& path, const Motion& motion) {
  const ReferencePath::Point reference = path.at(motion.s);
  const Eigen::Vector2d offset = motion.pose.position() - reference.position;
  const Eigen::Vector2d left(-std::sin(reference.yaw), std::cos(reference.yaw));
  const double lateral = std::clamp(offset.dot(left), -0.3, 0.3);
  const double heading = angleBetween(reference.yaw, motion.pose.yaw);
  return reference.curvature - kStiffness * lateral - kDamping * heading;
}

/// Highest speed after one more step that still obeys the profile there.
double nextSpeed(const SpeedProfile& profile, const Motion& motion, const MotionLimits& limits, double dt) {
  double speed = motion.speed;
  for (int i = 0; i < 3; ++i) {
    const double wanted = profile.at(motion.s + 0.5 * (motion.speed + speed) * dt);
    speed = approach(motion.speed, wanted, limits.acceleration * dt);
  }
  const double left = profile.stop() - motion.s;
  const bool ends = left < 0.01 && motion.speed <= limits.acceleration * dt;
  return std::max(0.0, ends ? 0.0 : speed);
}

Motion advanced(const ReferencePath& path, const SpeedProfile& profile, const Motion& motion, const MotionLimits& limits,
                double dt) {
  Motion next;
  next.speed = nextSpeed(profile, motion, limits, dt);
  const double curvature = wantedCurvature(path, motion);
  // A curve too tight for the speed makes the drive slow down until it can turn as wanted.
  if (std::abs(curvature) * next.speed > limits.turn_rate) {
    next.speed = std::max(std::max(0.0, motion.speed - limits.acceleration * dt), limits.turn_rate / std::abs(curvature));
    next.speed = std::min(next.speed, motion.speed + limits.acceleration * dt);
  }
  const double turn_rate = std::clamp(curvature * next.speed, -limits.turn_rate, limits.turn_rate);
  next.turn_rate = approach(motion.turn_rate, turn_rate, limits.turn_acceleration * dt);
  next.pose = integrateTwist(motion.pose, 0.5 * (motion.speed + next.speed), 0.5 * (motion.turn_rate + next.turn_rate), dt);
  next.s = std::max(motion.s, path.project(next.pose.position(), motion.s, kProjectReach));
  return next;
}

bool stands(const Motion& motion) { return motion.speed < 1e-9 && std::abs(motion.turn_rate) < 1e-9; }

}  // namespace

PathDrive followPath(const ReferencePath& path, const SpeedProfile& profile, const TrajectoryPoint& start, bool reverse,
                     const MotionLimits& limits, double time_step) {
  const double sign = reverse ? -1.0 : 1.0;
  const double turned = reverse ? kPi : 0.0;
  Motion motion;
  motion.pose = {start.pose.x, start.pose.y, wrapAngle(start.pose.yaw + turned)};
  motion.speed = std::max(-limits.acceleration * time_step, sign * start.twist.speed);  // it may still roll the other way
  motion.turn_rate = start.twist.turn_rate;
  motion.s = path.project(motion.pose.position(), 0.0, kProjectReach);
  PathDrive drive;
  drive.points.push_back(start);
  drive.arc_lengths.push_back(motion.s);
  const int most = static_cast<int>(kLongestDrive / time_step);
  bool stood = false;  // a step from a stand to a stand is followed by more of the same
  for (int k = 1; k <= most; ++k) {
    motion = advanced(path, profile, motion, limits, time_step);
    const Pose2 pose{motion.pose.x, motion.pose.y, wrapAngle(motion.pose.yaw - turned)};
    drive.points.push_back({start.time + k * time_step, pose, {sign * motion.speed, motion.turn_rate}});
    drive.arc_lengths.push_back(motion.s);
    if (stands(motion) && (stood || profile.at(motion.s) < 0.02)) break;
    stood = stands(motion);
  }
  drive.points.back().twist = {};
  return drive;
}

std::vector<TrajectoryPoint> turnOnSpot(const TrajectoryPoint& start, double yaw, const MotionLimits& limits, double time_step) {
  const double turn = angleBetween(start.pose.yaw, yaw);
  const double sign = turn < 0.0 ? -1.0 : 1.0, angle = std::abs(turn);
  // Trapezoid of the turn rate: ramps of `ramp` seconds up to `peak`, with `hold` seconds between.
  const double peak = std::min(limits.turn_rate, std::sqrt(angle * limits.turn_acceleration));
  const double ramp = peak / limits.turn_acceleration;
  const double hold = peak > 0.0 ? std::max(0.0, angle / peak - ramp) : 0.0;
  const double total = 2.0 * ramp + hold;
  std::vector<TrajectoryPoint> points;
  const int steps = static_cast<int>(std::ceil(total / time_step));
  for (int k = 0; k <= steps; ++k) {
    const double t = std::min(total, k * time_step);
    const double rising = std::min(t, ramp), level = std::clamp(t - ramp, 0.0, hold);
    const double falling = std::clamp(t - ramp - hold, 0.0, ramp);
    const double a = limits.turn_acceleration;
    const double turned = 0.5 * a * rising * rising + peak * level + peak * falling - 0.5 * a * falling * falling;
    const double rate = std::max(0.0, a * rising - a * falling);
    points.push_back(
        {start.time + t, {start.pose.x, start.pose.y, wrapAngle(start.pose.yaw + sign * turned)}, {0.0, sign * rate}});
  }
  points.back().twist = {};
  points.back().pose.yaw = wrapAngle(yaw);
  return points;
}

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <deque>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "parley_control/controller.h"

namespace parley::testing {

inline Footprint footprint() { return {0.8, 0.4}; }
inline MotionLimits limits() { return {2.0, kPi / 2.0, 2.0, 3.0}; }

/// A differential drive that takes up a command as fast as its accelerations allow and moves exactly.
struct Drive {
  Pose2 pose;
  Twist2 twist;

  void run(const Twist2& command, double duration) {
    constexpr int kSubsteps = 10;
    const double dt = duration / kSubsteps;
    const MotionLimits l = limits();
    for (int i = 0; i < kSubsteps; ++i) {
      twist.speed += std::clamp(command.speed - twist.speed, -l.acceleration * dt, l.acceleration * dt);
      twist.turn_rate += std::clamp(command.turn_rate - twist.turn_rate, -l.turn_acceleration * dt, l.turn_acceleration * dt);
      pose = integrateTwist(pose, twist.speed, twist.turn_rate, dt);
    }
  }
};

struct Wall {
  Eigen::Vector2d from, to;  // [m] odom frame
};

/// What a lidar in the middle of the robot sees of some walls, on 720 bearings up to 4 m.
inline ObstacleScan scanOf(const std::vector<Wall>& walls, const Pose2& pose, double stamp) {
  ObstacleScan scan;
  scan.stamp = stamp;
  scan.range_max = 4.0;
  scan.ranges.assign(720, std::numeric_limits<float>::infinity());
  scan.transient.assign(720, false);
  std::vector<Eigen::Vector2d> ends;
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) ends.push_back(pose * scan.pointAt(i, scan.range_max));
  for (const Wall& wall : walls) {
    if (pointSegmentDistance(pose.position(), wall.from, wall.to) > scan.range_max) continue;
    for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
      const auto hit = segmentIntersection(pose.position(), ends[i], wall.from, wall.to);
      if (hit) scan.ranges[i] = std::min(scan.ranges[i], static_cast<float>((*hit - pose.position()).norm()));
    }
  }
  return scan;
}

/// Distance of the footprint from the nearest wall, 0 if it touches. [m]
inline double clearance(const std::vector<Wall>& walls, const Pose2& pose) {
  double least = std::numeric_limits<double>::infinity();
  const Polygon body = footprint().polygonAt(pose);
  for (const Wall& wall : walls) {
    if (contains(body, wall.from)) return 0.0;
    for (std::size_t i = 0; i < body.size(); ++i) {
      least = std::min(least, segmentDistance(body[i], body[(i + 1) % body.size()], wall.from, wall.to));
    }
  }
  return least;
}

/// A trajectory by its twist over time, integrated finely and kept every 50 ms.
inline SampledTrajectory trajectoryOf(const Pose2& start, double start_time, double duration,
                                      const std::function<Twist2(double)>& twist) {
  constexpr double kStep = 0.001;
  constexpr int kKeep = 50;
  std::vector<TrajectoryPoint> points{{start_time, start, twist(0.0)}};
  Pose2 pose = start;
  const int steps = static_cast<int>(std::round(duration / kStep));
  for (int i = 1; i <= steps; ++i) {
    const Twist2 middle = twist((i - 0.5) * kStep);
    pose = integrateTwist(pose, middle.speed, middle.turn_rate, kStep);
    if (i % kKeep == 0 || i == steps) points.push_back({start_time + i * kStep, pose, twist(i * kStep)});
  }
  return SampledTrajectory(std::move(points));
}

/// Rises to 1 within `ramp`, stays, and falls back to 0 at `duration`. [s]
inline double trapezoid(double t, double duration, double ramp) { return std::clamp(std::min(t, duration - t) / ramp, 0.0, 1.0); }

/// A robot, its controller and a world, stepped together at 50 Hz. The lidar turns at 10 Hz.
struct ClosedLoop {
  explicit ClosedLoop(const ControlOptions& options = {}) : controller(options, footprint(), limits()) {}

  ControlResult step(const SampledTrajectory& trajectory) {
    if (!scan_is_held && now - scan.stamp > 0.099) look();
    if (!odometry_is_held) odometry = {now, drive.pose, drive.twist, 0.0, 0.0};
    ControlRequest request;
    request.now = now;
    request.odometry = &odometry;
    request.trajectory = &trajectory;
    request.trajectory_stamp = planner_is_silent ? 0.0 : now;
    request.scan = &scan;
    request.T_odom_scan = T_odom_scan;
    const ControlResult result = controller.step(request);
    underway.push_back(result.twist);
    while (underway.size() > delay_steps + 1) underway.pop_front();
    drive.run(underway.size() > delay_steps ? underway.front() : Twist2{}, kPeriod);
    now += kPeriod;
    return result;
  }

  void look() {
    scan = scanOf(walls, drive.pose, now);
    T_odom_scan = drive.pose;
  }

  static constexpr double kPeriod = 0.02;
  Controller controller;
  Drive drive;
  std::deque<Twist2> underway;  // commands that the drive has not got yet
  std::size_t delay_steps = 0;  // [-] between a command and its effect
  std::vector<Wall> walls;
  double now = 100.0;
  bool planner_is_silent = false;
  bool odometry_is_held = false;
  bool scan_is_held = false;
  Odometry odometry;
  ObstacleScan scan;
  Pose2 T_odom_scan;
};

}  // namespace parley::testing

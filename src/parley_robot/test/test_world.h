// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "parley_geometry/motion.h"
#include "parley_geometry/scan.h"

namespace parley::test {

struct Wall {
  Eigen::Vector2d a, b;
};

inline std::vector<Wall> box(double x1, double y1, double x2, double y2) {
  return {{{x1, y1}, {x2, y1}}, {{x2, y1}, {x2, y2}}, {{x2, y2}, {x1, y2}}, {{x1, y2}, {x1, y1}}};
}

inline double rayLength(const std::vector<Wall>& walls, const Eigen::Vector2d& from, double bearing) {
  const Eigen::Vector2d d(std::cos(bearing), std::sin(bearing));
  double nearest = std::numeric_limits<double>::infinity();
  for (const Wall& wall : walls) {
    const Eigen::Vector2d e = wall.b - wall.a, o = wall.a - from;
    const double det = d.x() * e.y() - d.y() * e.x();
    if (std::abs(det) < 1e-12) continue;
    const double t = (o.x() * e.y() - o.y() * e.x()) / det;
    const double u = (o.x() * d.y() - o.y() * d.x()) / det;
    if (t > 0.0 && u >= 0.0 && u <= 1.0) nearest = std::min(nearest, t);
  }
  return nearest;
}

/// 720 exact beams, 4 m, seen from `pose`.
inline RangeScan scanFrom(const std::vector<Wall>& walls, const Pose2& pose, double stamp) {
  RangeScan scan;
  scan.stamp = stamp;
  scan.angle_increment = 2.0 * kPi / 720.0;
  scan.angle_min = -kPi + 0.5 * scan.angle_increment;
  scan.range_min = 0.05;
  scan.range_max = 4.0;
  for (int i = 0; i < 720; ++i) {
    const double range = rayLength(walls, pose.position(), pose.yaw + scan.angle_min + i * scan.angle_increment);
    scan.ranges.push_back(range <= 4.0 ? static_cast<float>(range) : std::numeric_limits<float>::infinity());
  }
  return scan;
}

/// A differential drive that obeys within its acceleration limits.
struct IdealDrive {
  Pose2 pose;
  Twist2 twist;

  void step(const Twist2& command, const MotionLimits& limits, double dt) {
    const auto towards = [dt](double value, double target, double rate) {
      return value + std::clamp(target - value, -rate * dt, rate * dt);
    };
    twist.speed = towards(twist.speed, std::clamp(command.speed, -limits.speed, limits.speed), limits.acceleration);
    twist.turn_rate =
        towards(twist.turn_rate, std::clamp(command.turn_rate, -limits.turn_rate, limits.turn_rate), limits.turn_acceleration);
    pose = integrateTwist(pose, twist.speed, twist.turn_rate, dt);
  }
};

}  // namespace parley::test

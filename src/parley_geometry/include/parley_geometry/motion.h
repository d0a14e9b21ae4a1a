// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "parley_geometry/options.h"
#include "parley_geometry/pose2.h"

namespace parley {

/// Velocity of a differential drive in its own frame.
struct Twist2 {
  double speed = 0.0;      // [m/s] along x of base_link, negative is backwards
  double turn_rate = 0.0;  // [rad/s] counter-clockwise
};

/// What odometry says: pose of base_link in the robot's own odom frame and the velocity of base_link in itself.
struct Odometry {
  double stamp = 0.0;  // [s] of the robot's clock
  Pose2 pose;          // T_odom_base
  Twist2 twist;
  double roll = 0.0;   // [rad] attitude, gravity aligned; 0 where odometry is planar
  double pitch = 0.0;  // [rad]
};

/// What a differential drive can do. Has no default: whoever starts a robot says it.
struct MotionLimits {
  double speed = 0.0;              // [m/s]
  double turn_rate = 0.0;          // [rad/s]
  double acceleration = 0.0;       // [m/s^2] speeding up and braking
  double turn_acceleration = 0.0;  // [rad/s^2]

  template <class Visitor>
  void visit(Visitor& v) {
    v.number("speed", speed, "m/s", 0.05, 10.0, "highest speed, forwards and backwards");
    v.number("turn_rate", turn_rate, "rad/s", 0.05, 10.0, "highest turn rate");
    v.number("acceleration", acceleration, "m/s^2", 0.05, 20.0, "highest acceleration and braking");
    v.number("turn_acceleration", turn_acceleration, "rad/s^2", 0.05, 50.0, "highest change of the turn rate");
  }
};

}  // namespace parley

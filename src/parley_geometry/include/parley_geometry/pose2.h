// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "parley_geometry/angles.h"

namespace parley {

/// A rigid motion of the plane. As T_parent_child it maps child coordinates into the parent frame.
struct Pose2 {
  double x = 0.0;    // [m]
  double y = 0.0;    // [m]
  double yaw = 0.0;  // [rad]

  Eigen::Vector2d position() const { return {x, y}; }
  Eigen::Vector2d direction() const { return {std::cos(yaw), std::sin(yaw)}; }

  /// T_parent_child * p_child = p_parent.
  Eigen::Vector2d operator*(const Eigen::Vector2d& p) const {
    const double c = std::cos(yaw), s = std::sin(yaw);
    return {x + c * p.x() - s * p.y(), y + s * p.x() + c * p.y()};
  }

  /// T_a_b * T_b_c = T_a_c, yaw in [-pi, pi).
  Pose2 operator*(const Pose2& other) const {
    const Eigen::Vector2d p = *this * other.position();
    return {p.x(), p.y(), wrapAngle(yaw + other.yaw)};
  }

  /// T_b_a of T_a_b.
  Pose2 inverse() const {
    const double c = std::cos(yaw), s = std::sin(yaw);
    return {-c * x - s * y, s * x - c * y, wrapAngle(-yaw)};
  }

  bool isFinite() const { return std::isfinite(x) && std::isfinite(y) && std::isfinite(yaw); }
};

inline bool operator==(const Pose2& a, const Pose2& b) { return a.x == b.x && a.y == b.y && a.yaw == b.yaw; }

/// The pose a fraction of the way from a to b, yaw by the shorter way. fraction in [0, 1].
inline Pose2 interpolate(const Pose2& a, const Pose2& b, double fraction) {
  return {a.x + fraction * (b.x - a.x), a.y + fraction * (b.y - a.y), wrapAngle(a.yaw + fraction * angleBetween(a.yaw, b.yaw))};
}

/// Constant-twist motion for dt seconds: exact arc of a body moving forward at `speed` [m/s], turning at `turn_rate` [rad/s].
inline Pose2 integrateTwist(const Pose2& pose, double speed, double turn_rate, double dt) {
  const double turn = turn_rate * dt;
  const double chord = std::abs(turn) < 1e-6 ? speed * dt : 2.0 * speed / turn_rate * std::sin(0.5 * turn);
  const double heading = pose.yaw + 0.5 * turn;
  return {pose.x + chord * std::cos(heading), pose.y + chord * std::sin(heading), wrapAngle(pose.yaw + turn)};
}

}  // namespace parley

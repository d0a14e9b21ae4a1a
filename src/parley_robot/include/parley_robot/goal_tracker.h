// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>

#include "parley_geometry/motion.h"

namespace parley {

/// Holds the goal and says whether the robot has arrived: once it has stood within the tolerance, until it is moved away.
class GoalTracker {
 public:
  GoalTracker(double tolerance, double hysteresis) : tolerance_(tolerance), hysteresis_(hysteresis) {}

  /// A goal in the odom frame; refused (false) if not finite.
  bool set(const Eigen::Vector2d& goal_odom);
  /// The frame has moved, the robot in it has not: the same goal in the new one.
  void carry(const Pose2& T_new_old) {
    if (goal_) goal_ = T_new_old * *goal_;
  }
  void cancel() { goal_.reset(); }

  /// Brings `arrived()` up to date with a new reading; returns it.
  bool update(const Odometry& odometry);

  const std::optional<Eigen::Vector2d>& goal() const { return goal_; }
  bool arrived() const { return arrived_; }
  double tolerance() const { return tolerance_; }

 private:
  double tolerance_;   // [m]
  double hysteresis_;  // [m]
  std::optional<Eigen::Vector2d> goal_;
  bool arrived_ = false;
};

}  // namespace parley

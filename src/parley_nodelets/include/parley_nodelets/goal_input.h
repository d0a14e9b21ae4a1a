// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>

#include "parley_geometry/pose2.h"
#include "parley_nodelets/node_config.h"

namespace parley {

/// What somebody wants of the robot.
struct GoalOrder {
  std::optional<Eigen::Vector2d> goal_local;  // [m] nothing: stand
};

/// Takes goals from the topic `move_base_simple/goal` and the action `move_base`, brings them into the odom frame by
/// tf, where they stay, and tells the action's client how they ended. The newest goal replaces the one before, whichever way
/// either came.
class GoalInput {
 public:
  GoalInput(const ros::NodeHandle& nh, const Frames& frames);
  ~GoalInput();

  /// The newest order since the last call. A goal is held back until somebody has told where the local frame is; after five
  /// seconds without that it is refused, and the order is to stand. `now` is the planner's time. [s]
  std::optional<GoalOrder> take(double now);
  /// Where the last goal lies in the local frame, if that frame has moved in the odom frame since it was last told.
  std::optional<Eigen::Vector2d> moved();

  /// Whether the goal came by the action and is not finished yet.
  bool actionRuns() const;
  void feedback(const Pose2& T_local_base, double stamp);
  void succeed(const std::string& text);
  void abort(const std::string& text);

  /// Goals that could not be brought into the odom frame or were not finite.
  int refused() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace parley

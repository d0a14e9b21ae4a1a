// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <parley_msgs/Goal.h>
#include <parley_msgs/ObstacleScan.h>
#include <parley_msgs/Trajectory.h>

#include <optional>
#include <string>

#include "parley_control/controller.h"
#include "parley_nodelets/input_check.h"
#include "parley_nodelets/latest.h"
#include "parley_nodelets/node_config.h"
#include "parley_nodelets/odometry_input.h"
#include "parley_nodelets/worker.h"
#include "parley_robot/committed_plan.h"

namespace parley {

/// Control stage in ROS: `trajectory`, `goal`, `odom` and `obstacles` become `cmd_vel` and `robot_state`. Whichever way
/// it ends, the last thing it sends is a command to stand.
class ControlNode {
 public:
  /// Throws std::invalid_argument with all problems of the parameters.
  ControlNode(ros::NodeHandle nh, const ros::NodeHandle& pnh, const std::string& name);
  ~ControlNode();

 private:
  void step();
  void takeInputs(const OdometryBuffer& odometry);
  ControlResult control(double now, const OdometryBuffer& odometry);
  void publishTwist(const Twist2& twist);
  void report(diagnostic_updater::DiagnosticStatusWrapper& status) const;

  StageConfig<ControlOptions> config_;
  Worker worker_;
  diagnostic_updater::Updater diagnostics_;
  InputCheck inputs_;

  std::unique_ptr<Controller> controller_;
  CommittedPlan plan_;
  Continuity continuity_;
  bool has_goal_ = false;
  std::optional<ObstacleScan> scan_;
  Pose2 T_odom_scan_;
  ControlResult last_result_;
  int rejected_ = 0;  // [-] messages that were not usable

  ros::Publisher twist_;
  ros::Publisher state_;
  Latest<parley_msgs::TrajectoryConstPtr> new_trajectory_;
  Latest<parley_msgs::GoalConstPtr> new_goal_;
  Latest<parley_msgs::ObstacleScanConstPtr> new_scan_;
  OdometryInput odometry_;
  ros::Subscriber trajectory_subscriber_;
  ros::Subscriber goal_subscriber_;
  ros::Subscriber obstacles_subscriber_;
};

}  // namespace parley

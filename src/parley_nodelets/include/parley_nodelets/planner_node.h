// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <nav_msgs/OccupancyGrid.h>
#include <parley_msgs/ObstacleScan.h>
#include <parley_msgs/PeerMotions.h>
#include <parley_msgs/Route.h>
#include <parley_msgs/TrackedObjects.h>

#include <optional>
#include <string>
#include <vector>

#include "parley_geometry/local_map.h"
#include "parley_nodelets/goal_input.h"
#include "parley_nodelets/input_check.h"
#include "parley_nodelets/latest.h"
#include "parley_nodelets/motion_conversions.h"
#include "parley_nodelets/node_config.h"
#include "parley_nodelets/odometry_input.h"
#include "parley_nodelets/stage_conversions.h"
#include "parley_nodelets/worker.h"
#include "parley_planner/planner.h"
#include "parley_robot/committed_plan.h"
#include "parley_robot/goal_tracker.h"
#include "parley_robot/periodic.h"

namespace parley {

/// When a goal counts as reached, and when an action gives up.
struct GoalOptions {
  double tolerance = 0.3;    // [m]
  double patience = 30.0;    // [s]
  double map_timeout = 1.0;  // [s]

  template <class Visitor>
  void visit(Visitor& v) {
    v.number("tolerance", tolerance, "m", 0.05, 5.0, "standing this near to the goal is having arrived");
    v.number("patience", patience, "s", 1.0, 3600.0, "an action's goal is aborted after this long without a way to it");
    v.number("map_timeout", map_timeout, "s", 0.2, 60.0, "no plan is made on a local map older than this");
  }
};

struct PlannerConfig {
  NodeConfig node;
  PlannerOptions stage;
  GoalOptions goal;
};

/// Planner stage in ROS: goals, `odom`, `obstacles`, `tracks`, `local_map`, `route` and `peer_motions` become `trajectory` and
/// `goal`.
class PlannerNode {
 public:
  /// Throws std::invalid_argument with all problems of the parameters.
  PlannerNode(ros::NodeHandle nh, const ros::NodeHandle& pnh, const std::string& name);
  ~PlannerNode();

 private:
  void step();
  void takeOrder(double now);
  void carryGoal(double now);
  void takeInputs(const OdometryBuffer& odometry);
  void takeScan(const OdometryBuffer& odometry);
  void takeRoute();
  void takeTeam();
  bool isCurrent(const std_msgs::Header& header) const;
  PlanResult plan(double now, const Odometry& odometry, bool at_goal);
  void publish(const TimedPlan& plan);
  void publishGoal(double now);
  void answerAction(double now, const Odometry& odometry, const PlanResult& result);
  void forget();
  void report(diagnostic_updater::DiagnosticStatusWrapper& status) const;

  PlannerConfig config_;
  Worker worker_;
  diagnostic_updater::Updater diagnostics_;
  InputCheck inputs_;

  std::unique_ptr<Planner> planner_;
  std::unique_ptr<GoalTracker> goal_;
  CommittedPlan plan_;
  Continuity continuity_;
  PlanTrigger trigger_;
  std::optional<ObstacleScan> scan_;
  Pose2 T_odom_scan_;
  std::optional<LocalMap> map_;
  bool map_is_new_ = false;  // nothing has been planned on it yet
  std::vector<TrackedObject> tracks_;
  Route route_;
  TeamMotions team_;
  PlanResult last_plan_;
  double last_progress_ = 0.0;  // [s] when there was last a way to the goal
  int rejected_ = 0;            // [-] messages that were not usable

  ros::Publisher trajectory_;
  ros::Publisher path_;
  ros::Publisher goal_publisher_;
  ros::Publisher shut_passage_;
  Latest<parley_msgs::ObstacleScanConstPtr> new_scan_;
  Latest<parley_msgs::TrackedObjectsConstPtr> new_tracks_;
  Latest<nav_msgs::OccupancyGridConstPtr> new_map_;
  Latest<parley_msgs::RouteConstPtr> new_route_;
  Latest<parley_msgs::PeerMotionsConstPtr> new_team_;
  OdometryInput odometry_;
  std::vector<ros::Subscriber> subscribers_;
  std::unique_ptr<GoalInput> orders_;
};

}  // namespace parley

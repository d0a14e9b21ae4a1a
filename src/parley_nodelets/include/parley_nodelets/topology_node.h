// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <geometry_msgs/PointStamped.h>
#include <parley_msgs/Goal.h>
#include <parley_msgs/ObstacleScan.h>
#include <parley_msgs/PeerMaps.h>

#include <map>
#include <optional>
#include <string>

#include "parley_nodelets/input_check.h"
#include "parley_nodelets/latest.h"
#include "parley_nodelets/node_config.h"
#include "parley_nodelets/odometry_input.h"
#include "parley_nodelets/worker.h"
#include "parley_topology/topology.h"

namespace parley {

/// Topology stage in ROS: `obstacles`, `odom`, `goal`, `peer_maps` and `shut_passage` become `local_map`, `route`, `contours`,
/// `graph` and `topology_markers`.
class TopologyNode {
 public:
  /// Throws std::invalid_argument with all problems of the parameters.
  TopologyNode(ros::NodeHandle nh, const ros::NodeHandle& pnh, const std::string& name);
  ~TopologyNode();

 private:
  void integrate();
  void update();
  void takeGoal();
  void takePeerMaps();
  void takeShutPassage();
  void publishLocalMap(const Pose2& T_odom_base);
  void publishRoute(const Pose2& T_odom_base);
  void publishPictures();
  void forgetIfBroken(double now, const OdometrySnapshot& odometry);
  void report(diagnostic_updater::DiagnosticStatusWrapper& status) const;

  StageConfig<TopologyOptions> config_;
  Worker worker_;
  diagnostic_updater::Updater diagnostics_;
  InputCheck inputs_;

  std::unique_ptr<Topology> topology_;
  Continuity continuity_;
  std::optional<Eigen::Vector2d> goal_;  // [m] odom frame
  std::optional<double> newest_scan_;    // [s] stamp
  TopologyResult last_result_;
  Route route_;
  int rejected_ = 0;                         // [-] scans, peers' maps and passages
  std::map<std::string, ros::Time> layers_;  // peers' maps that are drawn: origin and version

  ros::Publisher local_map_;
  ros::Publisher route_publisher_;
  ros::Publisher contours_;
  ros::Publisher graph_;
  ros::Publisher markers_;
  Latest<parley_msgs::ObstacleScanConstPtr> obstacles_;
  Latest<parley_msgs::GoalConstPtr> new_goal_;
  Latest<parley_msgs::PeerMapsConstPtr> new_peer_maps_;
  Latest<geometry_msgs::PointStampedConstPtr> new_shut_passage_;
  OdometryInput odometry_;
  ros::Subscriber obstacles_subscriber_;
  ros::Subscriber goal_subscriber_;
  ros::Subscriber peer_maps_subscriber_;
  ros::Subscriber shut_passage_subscriber_;
};

}  // namespace parley

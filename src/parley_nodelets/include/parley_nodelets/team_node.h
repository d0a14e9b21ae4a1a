// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <parley_msgs/Contours.h>
#include <parley_msgs/MapLayer.h>
#include <parley_msgs/ObstacleScan.h>
#include <parley_msgs/RobotState.h>
#include <parley_msgs/Trajectory.h>
#include <tf2_ros/transform_broadcaster.h>

#include <deque>
#include <map>
#include <optional>
#include <string>

#include "parley_nodelets/input_check.h"
#include "parley_nodelets/latest.h"
#include "parley_nodelets/odometry_input.h"
#include "parley_nodelets/radio.h"
#include "parley_nodelets/report.h"
#include "parley_nodelets/team_config.h"
#include "parley_nodelets/worker.h"
#include "parley_robot/committed_plan.h"
#include "parley_robot/team_link.h"

namespace parley {

/// Exchange and relative localization in ROS: `odom`, `obstacles`, `contours`, `trajectory`, `robot_state` and the radio
/// become `peers`, `peer_motions`, `peer_maps`, `teammates`, and the frames of confirmed peers in tf.
class TeamNode {
 public:
  /// Throws std::invalid_argument with all problems of the parameters.
  TeamNode(ros::NodeHandle nh, const ros::NodeHandle& pnh, const std::string& name);
  ~TeamNode();

 private:
  void join();
  void subscribe(ros::NodeHandle& nh);
  OdometrySnapshot readOdometry(double now);
  void step();
  void takeInputs();
  void locate();
  void exchangeMaps();
  void publishTeammates(double now);
  void publishPeers(double now);
  void publishMotions(double now);
  void publishMaps(double now);
  void report(Report& report);
  void reportRadio(Report& report);

  TeamConfig config_;
  TeamKey key_;
  std::uint32_t joins_ = 0;  // [-] since the start
  Worker worker_;
  diagnostic_updater::Updater diagnostics_;
  InputCheck inputs_;

  std::optional<TeamLink> team_;  // nothing where it could not join anew
  CommittedPlan plan_;
  Continuity continuity_;
  DriveState state_ = DriveState::kStopped;
  std::map<std::string, parley_msgs::MapLayer> layers_;          // by origin, as published
  std::deque<std::pair<double, parley_msgs::Contour>> refuted_;  // when they were noticed [s], as published
  bool teammates_told_ = false;                                  // the last message named some
  double motions_told_ = -1e9;                                   // [s]
  int rejected_ = 0;                                             // [-] messages that were not usable
  double reported_at_ = 0.0;                                     // [s] and
  std::int64_t reported_bytes_ = 0;                              // [byte] at the last report

  ros::Publisher peers_;
  ros::Publisher peer_maps_;
  ros::Publisher teammates_;
  ros::Publisher motions_;
  ros::Publisher markers_;
  tf2_ros::TransformBroadcaster transforms_;
  Radio radio_;
  Latest<parley_msgs::TrajectoryConstPtr> new_trajectory_;
  Latest<parley_msgs::RobotStateConstPtr> new_state_;
  Latest<parley_msgs::ObstacleScanConstPtr> new_scan_;
  Latest<parley_msgs::ContoursConstPtr> new_contours_;
  OdometryInput odometry_;
  ros::Subscriber trajectory_subscriber_;
  ros::Subscriber state_subscriber_;
  ros::Subscriber obstacles_subscriber_;
  ros::Subscriber contours_subscriber_;
};

}  // namespace parley

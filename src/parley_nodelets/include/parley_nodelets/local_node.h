// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <nav_msgs/Odometry.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include <optional>
#include <string>

#include "parley_nodelets/input_check.h"
#include "parley_nodelets/node_config.h"
#include "parley_nodelets/worker.h"
#include "parley_robot/smooth_odometry.h"

namespace parley {

/// Odometry that is corrected now and then, as when it closes a loop, in a frame that takes no part in corrections: `odom`
/// becomes `local_odom`, and the transform from the odom frame to the local frame says where that lies at present. Where both
/// frames have one name, what comes in is passed on.
class LocalNode {
 public:
  /// Throws std::invalid_argument with all problems of the parameters.
  LocalNode(ros::NodeHandle nh, const ros::NodeHandle& pnh, const std::string& name);
  ~LocalNode();

 private:
  void process(const nav_msgs::Odometry& message);
  void place();
  void report(diagnostic_updater::DiagnosticStatusWrapper& status) const;

  NodeConfig config_;
  Worker worker_;
  diagnostic_updater::Updater diagnostics_;
  InputCheck inputs_;

  SmoothOdometry odometry_;
  std::optional<Pose2> placed_;  // T_odom_local, as it was told last
  int received_ = 0;             // [-]
  int wrong_frame_ = 0;          // [-]
  int malformed_ = 0;            // [-]

  ros::Publisher publisher_;
  tf2_ros::StaticTransformBroadcaster transforms_;
  ros::Subscriber subscriber_;
};

}  // namespace parley

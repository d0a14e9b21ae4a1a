// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <nav_msgs/Odometry.h>
#include <tf2_ros/transform_broadcaster.h>

#include <string>

#include "parley_geometry/spatial_odometry.h"
#include "parley_nodelets/input_check.h"
#include "parley_nodelets/node_config.h"
#include "parley_nodelets/worker.h"

namespace parley {

/// For lidar odometry that has poses in frames of its own and no twist, as Fast-LIO: `lidar_odometry` becomes `odom` and the
/// transforms from the odom frame to the base frame and to the frame that the poses came in.
class OdometryNode {
 public:
  /// Throws std::invalid_argument with all problems of the parameters.
  OdometryNode(ros::NodeHandle nh, const ros::NodeHandle& pnh, const std::string& name);
  ~OdometryNode();

 private:
  void process(const nav_msgs::Odometry& message);
  void publish(const Odometry& odometry, const std::string& start_frame);
  void report(diagnostic_updater::DiagnosticStatusWrapper& status) const;

  StageConfig<TwistOptions> config_;
  Worker worker_;
  diagnostic_updater::Updater diagnostics_;
  InputCheck inputs_;

  SpatialOdometry odometry_;
  int received_ = 0;         // [-]
  int malformed_ = 0;        // [-]
  double last_stamp_ = 0.0;  // [s] of what was published

  ros::Publisher publisher_;
  tf2_ros::TransformBroadcaster transforms_;
  ros::Subscriber subscriber_;
};

}  // namespace parley

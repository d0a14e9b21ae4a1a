// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <parley_msgs/Teammates.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/PointCloud2.h>

#include <string>
#include <vector>

#include "parley_lidar/lidar_stage.h"
#include "parley_nodelets/input_check.h"
#include "parley_nodelets/latest.h"
#include "parley_nodelets/node_config.h"
#include "parley_nodelets/odometry_input.h"
#include "parley_nodelets/worker.h"

namespace parley {

/// Lidar stage in ROS: `scan` or `points`, `odom` and `teammates` become `obstacles` and `tracks`.
class LidarNode {
 public:
  /// Throws std::invalid_argument with all problems of the parameters.
  LidarNode(ros::NodeHandle nh, const ros::NodeHandle& pnh, const std::string& name);
  ~LidarNode();

 private:
  void process();
  std::vector<KnownTeammate> bodies(double now);
  void publish(const LidarResult& result);
  void report(diagnostic_updater::DiagnosticStatusWrapper& status) const;

  StageConfig<LidarOptions> config_;
  Worker worker_;
  diagnostic_updater::Updater diagnostics_;
  InputCheck inputs_;

  std::unique_ptr<LidarStage> stage_;
  Continuity continuity_;
  Status<LidarCode> last_status_{LidarCode::kEmpty, "no scan yet"};
  double last_stamp_ = 0.0;  // [s]
  int accepted_ = 0;         // [-]
  int rejected_ = 0;         // [-]
  int malformed_ = 0;        // [-]
  std::vector<KnownTeammate> bodies_;
  double bodies_stamp_ = -1e9;  // [s]

  ros::Publisher obstacles_;
  ros::Publisher tracks_;
  Latest<sensor_msgs::LaserScanConstPtr> scan_;
  Latest<sensor_msgs::PointCloud2ConstPtr> cloud_;
  Latest<parley_msgs::TeammatesConstPtr> teammates_;
  OdometryInput odometry_;
  ros::Subscriber scan_subscriber_;
  ros::Subscriber cloud_subscriber_;
  ros::Subscriber teammates_subscriber_;
};

}  // namespace parley

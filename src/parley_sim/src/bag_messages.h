// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/PointCloud2.h>
#include <tf2_msgs/TFMessage.h>

#include "parley_geometry/motion.h"
#include "parley_geometry/scan.h"
#include "parley_sim/scenario.h"

namespace parley::sim {

/// Readings as a robot's drivers publish them. Stamps must be positive; frames by REP-105.
nav_msgs::Odometry odometryMessage(const Odometry& odometry);
tf2_msgs::TFMessage transformMessage(const Odometry& odometry);
tf2_msgs::TFMessage mountMessage(const LidarSpec& lidar, double stamp);
sensor_msgs::LaserScan scanMessage(const RangeScan& scan);
sensor_msgs::PointCloud2 cloudMessage(const LidarCloud& cloud);
geometry_msgs::PoseStamped goalMessage(const Eigen::Vector2d& goal_odom, double stamp);

}  // namespace parley::sim

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/Odometry.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/PointCloud2.h>
#include <std_msgs/Header.h>

#include <Eigen/Geometry>
#include <optional>
#include <string>

#include "parley_geometry/motion.h"
#include "parley_geometry/scan.h"

namespace parley {

/// ROS time of seconds; outside of what ros::Time can hold, the nearest it can.
ros::Time toRosTime(double seconds);
std_msgs::Header headerOf(double stamp, const std::string& frame);

geometry_msgs::Quaternion toQuaternion(double yaw);
geometry_msgs::Pose toPose(const Pose2& pose);

/// Yaw, and roll and pitch, of a rotation. nullopt unless it is finite and its norm is 1 within 0.1.
struct Attitude {
  double roll = 0.0;   // [rad]
  double pitch = 0.0;  // [rad]
  double yaw = 0.0;    // [rad]
};
std::optional<Attitude> attitudeOf(const geometry_msgs::Quaternion& rotation);

/// nullopt if the rotation is none. What else is not finite passes.
std::optional<Eigen::Isometry3d> spatialPose(const geometry_msgs::Pose& pose);

/// nullopt if the rotation is none. Other values that are not finite pass: the odometry buffer refuses them.
std::optional<Odometry> fromMessage(const nav_msgs::Odometry& message);
nav_msgs::Odometry toMessage(const Odometry& odometry, const std::string& odom_frame, const std::string& base_frame);

RangeScan fromMessage(const sensor_msgs::LaserScan& message);
sensor_msgs::LaserScan toMessage(const RangeScan& scan, const std::string& lidar_frame);

/// x, y, z as FLOAT32 at any offset; the time of a point, where there is one, from `time` (FLOAT32, s after the stamp),
/// `t` or `offset_time` (UINT32, ns after the stamp) or `timestamp` (FLOAT64, s or ns since 1970). nullopt if x, y or z
/// is missing, the data is big endian, or it is shorter than its header says.
std::optional<LidarCloud> fromMessage(const sensor_msgs::PointCloud2& message);
/// With fields x, y, z, time.
sensor_msgs::PointCloud2 toMessage(const LidarCloud& cloud, const std::string& lidar_frame);

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#include "parley_nodelets/sensor_conversions.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace parley {
namespace {

/// nullopt unless it is finite and its norm is 1 within 0.1.
std::optional<Eigen::Matrix3d> matrixOf(const geometry_msgs::Quaternion& rotation) {
  const Eigen::Quaterniond raw(rotation.w, rotation.x, rotation.y, rotation.z);
  if (!(std::abs(raw.norm() - 1.0) < 0.1)) return std::nullopt;  // NaN too
  return raw.normalized().toRotationMatrix();
}

}  // namespace

ros::Time toRosTime(double seconds) {
  constexpr double kLatest = std::numeric_limits<std::uint32_t>::max();
  if (!(seconds > 0.0)) return ros::Time(0.0);
  return ros::Time(std::min(seconds, kLatest - 1.0));
}

std_msgs::Header headerOf(double stamp, const std::string& frame) {
  std_msgs::Header header;
  header.stamp = toRosTime(stamp);
  header.frame_id = frame;
  return header;
}

geometry_msgs::Quaternion toQuaternion(double yaw) {
  geometry_msgs::Quaternion rotation;
  rotation.z = std::sin(0.5 * yaw);
  rotation.w = std::cos(0.5 * yaw);
  return rotation;
}

geometry_msgs::Pose toPose(const Pose2& pose) {
  geometry_msgs::Pose message;
  message.position.x = pose.x;
  message.position.y = pose.y;
  message.orientation = toQuaternion(pose.yaw);
  return message;
}

std::optional<Attitude> attitudeOf(const geometry_msgs::Quaternion& rotation) {
  const std::optional<Eigen::Matrix3d> matrix = matrixOf(rotation);
  if (!matrix) return std::nullopt;
  const Eigen::Matrix3d& r = *matrix;
  return Attitude{std::atan2(r(2, 1), r(2, 2)), std::asin(std::clamp(-r(2, 0), -1.0, 1.0)), std::atan2(r(1, 0), r(0, 0))};
}

std::optional<Eigen::Isometry3d> spatialPose(const geometry_msgs::Pose& pose) {
  const std::optional<Eigen::Matrix3d> rotation = matrixOf(pose.orientation);
  if (!rotation) return std::nullopt;
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.translation() = Eigen::Vector3d(pose.position.x, pose.position.y, pose.position.z);
  result.linear() = *rotation;
  return result;
}

std::optional<Odometry> fromMessage(const nav_msgs::Odometry& message) {
  const std::optional<Attitude> attitude = attitudeOf(message.pose.pose.orientation);
  if (!attitude) return std::nullopt;
  Odometry odometry;
  odometry.stamp = message.header.stamp.toSec();
  odometry.pose = {message.pose.pose.position.x, message.pose.pose.position.y, attitude->yaw};
  odometry.twist = {message.twist.twist.linear.x, message.twist.twist.angular.z};
  odometry.roll = attitude->roll;
  odometry.pitch = attitude->pitch;
  return odometry;
}

nav_msgs::Odometry toMessage(const Odometry& odometry, const std::string& odom_frame, const std::string& base_frame) {
  nav_msgs::Odometry message;
  message.header.stamp = toRosTime(odometry.stamp);
  message.header.frame_id = odom_frame;
  message.child_frame_id = base_frame;
  message.pose.pose.position.x = odometry.pose.x;
  message.pose.pose.position.y = odometry.pose.y;
  const Eigen::Quaterniond rotation = Eigen::AngleAxisd(odometry.pose.yaw, Eigen::Vector3d::UnitZ()) *
                                      Eigen::AngleAxisd(odometry.pitch, Eigen::Vector3d::UnitY()) *
                                      Eigen::AngleAxisd(odometry.roll, Eigen::Vector3d::UnitX());
  message.pose.pose.orientation.x = rotation.x();
  message.pose.pose.orientation.y = rotation.y();
  message.pose.pose.orientation.z = rotation.z();
  message.pose.pose.orientation.w = rotation.w();
  message.twist.twist.linear.x = odometry.twist.speed;
  message.twist.twist.angular.z = odometry.twist.turn_rate;
  return message;
}

RangeScan fromMessage(const sensor_msgs::LaserScan& message) {
  RangeScan scan;
  scan.stamp = message.header.stamp.toSec();
  scan.angle_min = message.angle_min;
  scan.angle_increment = message.angle_increment;
  scan.time_increment = message.time_increment;
  scan.range_min = message.range_min;
  scan.range_max = message.range_max;
  scan.ranges = message.ranges;
  return scan;
}

sensor_msgs::LaserScan toMessage(const RangeScan& scan, const std::string& lidar_frame) {
  sensor_msgs::LaserScan message;
  message.header.stamp = toRosTime(scan.stamp);
  message.header.frame_id = lidar_frame;
  message.angle_min = static_cast<float>(scan.angle_min);
  message.angle_increment = static_cast<float>(scan.angle_increment);
  const double last = scan.ranges.empty() ? 0.0 : static_cast<double>(scan.ranges.size() - 1);
  message.angle_max = static_cast<float>(scan.angle_min + last * scan.angle_increment);
  message.time_increment = static_cast<float>(scan.time_increment);
  message.range_min = static_cast<float>(scan.range_min);
  message.range_max = static_cast<float>(scan.range_max);
  message.ranges = scan.ranges;
  return message;
}

}  // namespace parley

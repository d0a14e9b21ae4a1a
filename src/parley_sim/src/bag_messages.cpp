// SPDX-License-Identifier: BSD-3-Clause
#include "bag_messages.h"

#include <Eigen/Geometry>
#include <cstring>

namespace parley::sim {
namespace {

constexpr const char* kOdom = "odom";
constexpr const char* kBase = "base_link";
constexpr const char* kLidar = "lidar";

template <class Header>
Header header(double stamp, const char* frame) {
  Header result;
  result.stamp = ros::Time(stamp);
  result.frame_id = frame;
  return result;
}

geometry_msgs::Quaternion orientation(double roll, double pitch, double yaw) {
  const Eigen::Quaterniond rotation = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
                                      Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
                                      Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX());
  geometry_msgs::Quaternion message;
  message.x = rotation.x();
  message.y = rotation.y();
  message.z = rotation.z();
  message.w = rotation.w();
  return message;
}

sensor_msgs::PointField field(const char* name, std::uint32_t offset) {
  sensor_msgs::PointField result;
  result.name = name;
  result.offset = offset;
  result.datatype = sensor_msgs::PointField::FLOAT32;
  result.count = 1;
  return result;
}

}  // namespace

nav_msgs::Odometry odometryMessage(const Odometry& odometry) {
  nav_msgs::Odometry message;
  message.header = header<std_msgs::Header>(odometry.stamp, kOdom);
  message.child_frame_id = kBase;
  message.pose.pose.position.x = odometry.pose.x;
  message.pose.pose.position.y = odometry.pose.y;
  message.pose.pose.orientation = orientation(odometry.roll, odometry.pitch, odometry.pose.yaw);
  message.twist.twist.linear.x = odometry.twist.speed;
  message.twist.twist.angular.z = odometry.twist.turn_rate;
  return message;
}

tf2_msgs::TFMessage transformMessage(const Odometry& odometry) {
  geometry_msgs::TransformStamped transform;
  transform.header = header<std_msgs::Header>(odometry.stamp, kOdom);
  transform.child_frame_id = kBase;
  transform.transform.translation.x = odometry.pose.x;
  transform.transform.translation.y = odometry.pose.y;
  transform.transform.rotation = orientation(odometry.roll, odometry.pitch, odometry.pose.yaw);
  tf2_msgs::TFMessage message;
  message.transforms.push_back(transform);
  return message;
}

tf2_msgs::TFMessage mountMessage(const LidarSpec& lidar, double stamp) {
  geometry_msgs::TransformStamped transform;
  transform.header = header<std_msgs::Header>(stamp, kBase);
  transform.child_frame_id = kLidar;
  transform.transform.translation.x = lidar.pose.x;
  transform.transform.translation.y = lidar.pose.y;
  transform.transform.translation.z = lidar.height;
  transform.transform.rotation = orientation(0.0, 0.0, lidar.pose.yaw);
  tf2_msgs::TFMessage message;
  message.transforms.push_back(transform);
  return message;
}

sensor_msgs::LaserScan scanMessage(const RangeScan& scan) {
  sensor_msgs::LaserScan message;
  message.header = header<std_msgs::Header>(scan.stamp, kLidar);
  message.angle_min = static_cast<float>(scan.angle_min);
  message.angle_increment = static_cast<float>(scan.angle_increment);
  message.angle_max = static_cast<float>(scan.angle_min + scan.angle_increment * (static_cast<double>(scan.ranges.size()) - 1.0));
  message.time_increment = static_cast<float>(scan.time_increment);
  message.range_min = static_cast<float>(scan.range_min);
  message.range_max = static_cast<float>(scan.range_max);
  message.ranges = scan.ranges;
  return message;
}

sensor_msgs::PointCloud2 cloudMessage(const LidarCloud& cloud) {
  static_assert(sizeof(LidarPoint) == 16, "points are copied as they are");
  sensor_msgs::PointCloud2 message;
  message.header = header<std_msgs::Header>(cloud.stamp, kLidar);
  message.height = 1;
  message.width = static_cast<std::uint32_t>(cloud.points.size());
  message.fields = {field("x", 0), field("y", 4), field("z", 8), field("time", 12)};
  message.point_step = sizeof(LidarPoint);
  message.row_step = message.point_step * message.width;
  message.is_dense = 1;
  message.data.resize(message.row_step);
  if (!cloud.points.empty()) std::memcpy(message.data.data(), cloud.points.data(), message.data.size());
  return message;
}

geometry_msgs::PoseStamped goalMessage(const Eigen::Vector2d& goal_odom, double stamp) {
  geometry_msgs::PoseStamped message;
  message.header = header<std_msgs::Header>(stamp, kOdom);
  message.pose.position.x = goal_odom.x();
  message.pose.position.y = goal_odom.y();
  message.pose.orientation.w = 1.0;
  return message;
}

}  // namespace parley::sim

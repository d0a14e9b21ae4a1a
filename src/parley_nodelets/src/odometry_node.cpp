// SPDX-License-Identifier: BSD-3-Clause
#include "parley_nodelets/odometry_node.h"

#include "parley_nodelets/report.h"
#include "parley_nodelets/sensor_conversions.h"

namespace parley {
namespace {

constexpr int kQueue = 100;   // every pose counts
constexpr double kOld = 0.5;  // [s]

Eigen::Isometry3d poseOf(const LidarMount& mount) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translate(Eigen::Vector3d(mount.x, mount.y, mount.z));
  pose.rotate(Eigen::AngleAxisd(mount.yaw, Eigen::Vector3d::UnitZ()));
  return pose;
}

}  // namespace

OdometryNode::OdometryNode(ros::NodeHandle nh, const ros::NodeHandle& pnh, const std::string& name)
    : config_(loadStageConfig<TwistOptions>(pnh)),
      worker_(name, [] {}),
      diagnostics_(nh, pnh, name),
      inputs_(nh, name),
      odometry_(poseOf(config_.node.mount), config_.stage, config_.node.limits),
      publisher_(nh.advertise<nav_msgs::Odometry>("odom", kQueue)) {
  const auto take = [this](const nav_msgs::OdometryConstPtr& m) { worker_.post([this, m] { process(*m); }); };
  subscriber_ = nh.subscribe<nav_msgs::Odometry>("lidar_odometry", kQueue, take, nullptr, ros::TransportHints().tcpNoDelay());
  inputs_.expect<nav_msgs::Odometry>(subscriber_);
  diagnostics_.setHardwareID(config_.node.frames.base);
  diagnostics_.add("stage", [this](Report& status) { report(status); });
  worker_.every(nh, 1.0, [this] { diagnostics_.update(); });
  worker_.start();
}

OdometryNode::~OdometryNode() { worker_.stop(); }

void OdometryNode::process(const nav_msgs::Odometry& message) {
  ++received_;
  const std::optional<Eigen::Isometry3d> pose = spatialPose(message.pose.pose);
  if (!pose) {
    ++malformed_;
  } else if (const std::optional<Odometry> odometry = odometry_.add(message.header.stamp.toSec(), *pose)) {
    publish(*odometry, message.header.frame_id);
  }
}

/// With the base goes the frame that the poses came in, so that what is in that tree has its place beside the robot.
void OdometryNode::publish(const Odometry& odometry, const std::string& start_frame) {
  last_stamp_ = odometry.stamp;
  const Frames& frames = config_.node.frames;
  const auto message = boost::make_shared<nav_msgs::Odometry>(toMessage(odometry, frames.odom, frames.base));
  publisher_.publish(message);
  geometry_msgs::TransformStamped transform;
  transform.header = message->header;
  transform.child_frame_id = frames.base;
  transform.transform.translation.x = odometry.pose.x;
  transform.transform.translation.y = odometry.pose.y;
  transform.transform.rotation = message->pose.pose.orientation;
  transforms_.sendTransform(transform);
  if (start_frame.empty() || start_frame == frames.odom) return;
  const LidarMount& mount = config_.node.mount;
  transform.child_frame_id = start_frame;
  transform.transform.translation.x = mount.x;
  transform.transform.translation.y = mount.y;
  transform.transform.translation.z = mount.z;
  transform.transform.rotation = toQuaternion(mount.yaw);
  transforms_.sendTransform(transform);
}

void OdometryNode::report(Report& report) const {
  report.summary(Report::OK, "");
  if (received_ == 0) {
    report.mergeSummary(Report::WARN, "no lidar odometry");
  } else if (ros::Time::now().toSec() - last_stamp_ > kOld) {
    report.mergeSummary(Report::WARN, "no usable lidar odometry for more than 0.5 s");
  }
  report.add("poses received", received_);
  report.add("poses malformed", malformed_);
  report.add("poses dropped", odometry_.dropped());
  report.add("corrections", odometry_.corrections());
  report.add("exceptions", worker_.errors());
}

}  // namespace parley

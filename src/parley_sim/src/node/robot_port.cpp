// SPDX-License-Identifier: BSD-3-Clause
#include "robot_port.h"

#include <geometry_msgs/PoseStamped.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/PointCloud2.h>

#include "parley_nodelets/sensor_conversions.h"

namespace parley::sim {
namespace {

constexpr double kCommandTimeout = 0.5;  // [s] as the drives of real robots have it
constexpr std::uint32_t kOdometryQueue = 50;
constexpr std::uint32_t kRadioQueue = 200;  // [-] packets
constexpr std::size_t kMostSent = 100;      // [-] packets of a robot in one step; what is beyond is lost

}  // namespace

RobotPort::RobotPort(const ros::NodeHandle& nh, const RobotSpec& spec) : name_(spec.name), goal_odom_(spec.goalInOdom()) {
  ros::NodeHandle own(nh, name_);
  scan_ = own.advertise<sensor_msgs::LaserScan>("scan", 1);
  points_ = own.advertise<sensor_msgs::PointCloud2>("points", 1);
  odometry_ = own.advertise<nav_msgs::Odometry>("odom", kOdometryQueue);
  truth_ = own.advertise<nav_msgs::Odometry>("base_pose_ground_truth", 1);
  goal_ = own.advertise<geometry_msgs::PoseStamped>("move_base_simple/goal", 1, true);
  received_ = own.advertise<parley_msgs::Packet>("radio/received", kRadioQueue);
  const ros::TransportHints hints = ros::TransportHints().tcpNoDelay();
  command_subscriber_ = own.subscribe<geometry_msgs::Twist>(
      "cmd_vel", 1, [this](const geometry_msgs::TwistConstPtr& m) { onCommand(*m); }, nullptr, hints);
  state_subscriber_ = own.subscribe<parley_msgs::RobotState>(
      "robot_state", 1, [this](const parley_msgs::RobotStateConstPtr& m) { onState(*m); }, nullptr, hints);
  sent_subscriber_ = own.subscribe<parley_msgs::Packet>(
      "radio/sent", kRadioQueue, [this](const parley_msgs::PacketConstPtr& m) { onSent(*m); }, nullptr, hints);
}

bool RobotPort::isConnected() const {
  return command_subscriber_.getNumPublishers() > 0 && odometry_.getNumSubscribers() > 0 && goal_.getNumSubscribers() > 0;
}

void RobotPort::publish(const SensorReadings& readings) {
  if (readings.odometry) {
    odometry_.publish(boost::make_shared<nav_msgs::Odometry>(toMessage(*readings.odometry, frame("odom"), frame("base_link"))));
  }
  if (readings.scan) scan_.publish(boost::make_shared<sensor_msgs::LaserScan>(toMessage(*readings.scan, frame("lidar"))));
  if (readings.cloud) {
    points_.publish(boost::make_shared<sensor_msgs::PointCloud2>(toMessage(*readings.cloud, frame("lidar"))));
  }
  for (const Payload& payload : readings.packets) {
    auto packet = boost::make_shared<parley_msgs::Packet>();
    packet->stamp = toRosTime(readings.clock);
    packet->data = payload;
    received_.publish(packet);
  }
}

void RobotPort::publishTruth(const BodyState& body, double time, const std::string& world_frame) {
  Odometry truth;
  truth.stamp = time;
  truth.pose = body.pose;
  truth.twist = body.twist;
  truth_.publish(boost::make_shared<nav_msgs::Odometry>(toMessage(truth, world_frame, frame("base_link"))));
}

void RobotPort::publishGoal(double time) {
  auto message = boost::make_shared<geometry_msgs::PoseStamped>();
  message->header.stamp = toRosTime(time);
  message->header.frame_id = frame("odom");
  message->pose.position.x = goal_odom_.x();
  message->pose.position.y = goal_odom_.y();
  message->pose.orientation.w = 1.0;
  goal_.publish(message);
}

Twist2 RobotPort::command(double time) const { return time - command_time_ <= kCommandTimeout ? command_ : Twist2{}; }

void RobotPort::reset() {
  command_ = {};
  command_time_ = -1e9;
  state_ = DriveState::kStopped;
  sent_.clear();
}

void RobotPort::onCommand(const geometry_msgs::Twist& message) {
  command_ = {message.linear.x, message.angular.z};
  command_time_ = ros::Time::now().toSec();
}

void RobotPort::onState(const parley_msgs::RobotState& message) {
  if (message.state <= parley_msgs::RobotState::DEAD) state_ = static_cast<DriveState>(message.state);
}

void RobotPort::onSent(const parley_msgs::Packet& message) {
  if (sent_.size() < kMostSent) sent_.push_back(message.data);
}

}  // namespace parley::sim

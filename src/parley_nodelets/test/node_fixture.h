// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <ros/param.h>
#include <ros/ros.h>
#include <sensor_msgs/LaserScan.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "parley_nodelets/sensor_conversions.h"

namespace parley::test {

/// The last message of a topic and how many came.
template <class Message>
class Listener {
 public:
  Listener(ros::NodeHandle& nh, const std::string& topic)
      : subscriber_(nh.subscribe<Message>(topic, 100, [this](const typename Message::ConstPtr& m) {
          const std::lock_guard<std::mutex> lock(mutex_);
          last_ = m;
          ++count_;
        })) {}

  int count() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return count_;
  }
  typename Message::ConstPtr last() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return last_;
  }
  /// Counts from zero again.
  void clear() {
    const std::lock_guard<std::mutex> lock(mutex_);
    count_ = 0;
    last_.reset();
  }

 private:
  mutable std::mutex mutex_;
  typename Message::ConstPtr last_;
  int count_ = 0;
  ros::Subscriber subscriber_;
};

/// Parameters of a robot, and a standing robot's sensors in an empty room of 8 x 6 m, in time that the test lets pass.
class NodeFixture : public testing::Test {
 protected:
  NodeFixture() : spinner_(2) {
    for (const char* stage : {"lidar", "topology", "planner", "control"}) setParameters(pnh(stage));
    odometry_ = nh_.advertise<nav_msgs::Odometry>("local_odom", 100);
    scan_ = nh_.advertise<sensor_msgs::LaserScan>("scan", 10);
    setTime(10.0);
    spinner_.start();
  }
  ~NodeFixture() override { ros::param::del(nh_.getNamespace()); }

  ros::NodeHandle pnh(const std::string& stage) const { return ros::NodeHandle(nh_, stage); }

  static void setParameters(const ros::NodeHandle& own) {
    own.setParam("frames/odom", "odom");
    own.setParam("frames/local", "odom");
    own.setParam("frames/base", "base_link");
    own.setParam("robot/footprint/length", 0.8);
    own.setParam("robot/footprint/width", 0.4);
    own.setParam("robot/limits/speed", 2.0);
    own.setParam("robot/limits/turn_rate", 1.5708);
    own.setParam("robot/limits/acceleration", 2.0);
    own.setParam("robot/limits/turn_acceleration", 4.0);
    own.setParam("robot/mount/x", 0.0);
    own.setParam("robot/mount/y", 0.0);
    own.setParam("robot/mount/z", 0.5);
    own.setParam("robot/mount/yaw", 0.0);
  }

  void setTime(double time) {
    time_ = time;
    ros::Time::setNow(ros::Time(time));
  }

  nav_msgs::Odometry odometryAt(double time) const {
    Odometry odometry;
    odometry.stamp = time;
    return toMessage(odometry, "odom", "base_link");
  }

  sensor_msgs::LaserScan roomScan(double time) const {
    RangeScan scan;
    scan.stamp = time;
    scan.angle_increment = 2.0 * kPi / 720.0;
    scan.angle_min = -kPi;
    scan.range_min = 0.05;
    scan.range_max = 10.0;
    for (int i = 0; i < 720; ++i) {
      const double bearing = scan.angle_min + i * scan.angle_increment;
      const double x = 4.0 / std::max(1e-9, std::abs(std::cos(bearing)));
      const double y = 3.0 / std::max(1e-9, std::abs(std::sin(bearing)));
      scan.ranges.push_back(static_cast<float>(std::min(x, y)));
    }
    return toMessage(scan, "lidar");
  }

  /// Lets one tenth of a second pass: odometry at 50 Hz, one scan.
  void pass() {
    for (int i = 0; i < 5; ++i) {
      setTime(time_ + 0.02);
      odometry_.publish(odometryAt(time_));
      std::this_thread::sleep_for(std::chrono::milliseconds(4));
    }
    scan_.publish(roomScan(time_));
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }

  /// Lets time pass until something holds; false if it does not within 20 s of wall time.
  bool passUntil(const std::function<bool()>& holds) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (!holds()) {
      if (std::chrono::steady_clock::now() > end) return false;
      pass();
    }
    return true;
  }

  void passFor(double seconds) {
    for (const double end = time_ + seconds; time_ < end;) pass();
  }

  ros::NodeHandle nh_{"robot"};
  ros::AsyncSpinner spinner_;
  ros::Publisher odometry_, scan_;
  double time_ = 0.0;  // [s]
};

/// The text that a node refuses to start with.
template <class Node>
std::string refusal(const ros::NodeHandle& nh, const ros::NodeHandle& pnh) {
  try {
    const Node node(nh, pnh, "node");
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

}  // namespace parley::test

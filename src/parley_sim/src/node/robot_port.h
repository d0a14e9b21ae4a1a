// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/Twist.h>
#include <parley_msgs/Packet.h>
#include <parley_msgs/RobotState.h>
#include <ros/node_handle.h>

#include <string>
#include <utility>
#include <vector>

#include "parley_geometry/status.h"
#include "parley_sim/contacts.h"
#include "parley_sim/scenario.h"
#include "parley_sim/simulated_robot.h"

namespace parley::sim {

/// One simulated robot's topics, in a namespace of its name: its sensors and what its radio receives out, its commands and what
/// it sends in. Frames carry the robot's
/// name as prefix, as all robots share one tf tree.
class RobotPort {
 public:
  RobotPort(const ros::NodeHandle& nh, const RobotSpec& spec);

  const std::string& name() const { return name_; }
  std::string frame(const std::string& plain) const { return name_ + "/" + plain; }

  /// Whether its stages are up: they command, and they listen to odometry and goal.
  bool isConnected() const;

  void publish(const SensorReadings& readings);
  void publishTruth(const BodyState& body, double time, const std::string& world_frame);
  /// Latched: stages that start later get it too.
  void publishGoal(double time);

  /// The last command, or to stand if there was none for half a second. `time` [s] of the simulation.
  Twist2 command(double time) const;
  DriveState state() const { return state_; }
  /// What the robot has sent since the last call.
  std::vector<Payload> takeSent() { return std::exchange(sent_, {}); }
  /// Forgets commands, as when time starts again.
  void reset();

 private:
  void onCommand(const geometry_msgs::Twist& message);
  void onState(const parley_msgs::RobotState& message);
  void onSent(const parley_msgs::Packet& message);

  std::string name_;
  Eigen::Vector2d goal_odom_;  // [m]
  ros::Publisher scan_, points_, odometry_, truth_, goal_, received_;
  ros::Subscriber command_subscriber_, state_subscriber_, sent_subscriber_;
  std::vector<Payload> sent_;
  Twist2 command_;
  double command_time_ = -1e9;  // [s]
  DriveState state_ = DriveState::kStopped;
};

}  // namespace parley::sim

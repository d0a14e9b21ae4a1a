// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "parley_robot/robot_stack.h"
#include "test_world.h"

namespace parley::test {

inline RobotOptions optionsOf(const std::string& name, Variant variant) {
  RobotOptions options;
  options.name = name;
  options.footprint = {0.8, 0.4};
  options.limits = {2.0, 1.5708, 2.0, 4.0};
  options.key = simulatedTeamKey(7);
  options.variant = variant;
  return options;
}

/// A robot and where it is; nothing that it knows is right but by its own doing.
struct Robot {
  Robot(const RobotOptions& options, const Pose2& start, double clock_ahead)
      : stack(options), T_world_odom(start), clock(clock_ahead) {
    drive.pose = start;
  }
  Pose2 odometry() const { return T_world_odom.inverse() * drive.pose; }
  void go(const Eigen::Vector2d& goal_world) { stack.setGoal(T_world_odom.inverse() * goal_world); }

  RobotStack stack;
  Pose2 T_world_odom;
  double clock;  // [s] ahead of the world's
  IdealDrive drive;
  bool radio = true;
  RobotOutput output;
};

/// Robots in one world, in lockstep at 50 Hz, with a radio that delays by a step.
class Meeting {
 public:
  explicit Meeting(std::vector<Wall> walls, unsigned seed = 1) : walls_(std::move(walls)), random_(seed) {}
  Robot& add(const std::string& name, const Pose2& start, double clock_ahead, Variant variant = Variant::kFull) {
    return add(optionsOf(name, variant), start, clock_ahead);
  }
  Robot& add(const RobotOptions& options, const Pose2& start, double clock_ahead) {
    return robots_.emplace_back(options, start, clock_ahead);
  }
  void run(double seconds) {
    for (const double end = time_ + seconds; time_ < end;) step();
  }
  double time() const { return time_; }
  double loss = 0.0;  // [-] share of the packets, for each receiver by itself
  void setWalls(std::vector<Wall> walls) { walls_ = std::move(walls); }

  /// How far off a robot's idea of another's place is; nullopt unless it is confirmed. [m]
  static std::optional<double> errorOf(const Robot& robot, const Robot& other, const std::string& name) {
    const auto& teammates = robot.stack.team()->teammates();
    const auto found = teammates.find(robotIdOf(name));
    if (found == teammates.end() || found->second.estimate.state != PoseState::kConfirmed) return std::nullopt;
    const Pose2 T_local_base = other.stack.odomFromLocal().inverse() * other.odometry();
    const Pose2 believed =
        robot.T_world_odom * robot.stack.odomFromLocal() * found->second.estimate.T_odom_peerodom.pose * T_local_base;
    return (believed.position() - other.drive.pose.position()).norm();
  }

 private:
  void step() {
    time_ += 0.02;
    ++count_;
    for (std::size_t i = 0; i < robots_.size(); ++i) {
      Robot& robot = robots_[i];
      const double now = time_ + robot.clock;
      robot.stack.addOdometry({now, robot.odometry(), robot.drive.twist, 0.0, 0.0});
      if (count_ % 5 == static_cast<int>(i) % 5) robot.stack.addScan(scanFrom(seenBy(i), robot.drive.pose, now));
      for (std::size_t k = 0; k < robots_.size(); ++k) {
        if (k == i || !robots_[k].radio || !robot.radio) continue;
        for (const Packet& packet : sent_[k]) {
          if (std::uniform_real_distribution<double>(0.0, 1.0)(random_) >= loss) robot.stack.addPacket(packet);
        }
      }
      robot.output = robot.stack.step(now);
      robot.drive.step(robot.output.twist, {2.0, 1.5708, 2.0, 4.0}, 0.02);
    }
    sent_.assign(robots_.size(), {});
    for (std::size_t i = 0; i < robots_.size(); ++i) sent_[i] = robots_[i].output.packets;
  }

  std::vector<Wall> seenBy(std::size_t i) const {
    std::vector<Wall> walls = walls_;
    for (std::size_t k = 0; k < robots_.size(); ++k) {
      if (k == i) continue;
      const Polygon body = Footprint{0.8, 0.4}.polygonAt(robots_[k].drive.pose);
      for (std::size_t c = 0; c < body.size(); ++c) walls.push_back({body[c], body[(c + 1) % body.size()]});
    }
    return walls;
  }

  std::vector<Wall> walls_;
  std::mt19937 random_;
  std::deque<Robot> robots_;
  std::vector<std::vector<Packet>> sent_ = std::vector<std::vector<Packet>>(8);
  double time_ = 0.0;
  int count_ = 0;
};

}  // namespace parley::test

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "parley_geometry/footprint.h"
#include "parley_geometry/motion.h"
#include "parley_geometry/pose2.h"

namespace parley::sim {

enum class LidarMode { kPlanar, kSpatial };

struct LidarSpec {
  double range = 4.0;   // [m]
  int beams = 720;      // [-] of a planar one over the whole turn
  double rate = 10.0;   // [Hz]
  double noise = 0.02;  // [m] standard deviation
  LidarMode mode = LidarMode::kPlanar;
  Pose2 pose;           // T_base_lidar
  double height = 0.5;  // [m] above base_link
};

struct OdometrySpec {
  double rate = 50.0;                // [Hz]
  double translation_noise = 0.003;  // [m / sqrt(m)]
  double rotation_noise = 0.0002;    // [rad / sqrt(m)]
};

struct ClockSpec {
  double offset = 0.0;  // [s]
  double drift = 0.0;   // [s/s]

  double at(double time) const { return offset + (1.0 + drift) * time; }
};

struct RadioSpec {
  double range = 10.0;         // [m]
  double success_rate = 1.0;   // [-]
  double latency = 0.02;       // [s]
  double jitter = 0.01;        // [s] uniform, both ways
  double bandwidth = 65536.0;  // [byte/s] 0 = no limit
  bool line_of_sight = false;
};

struct RobotSpec {
  std::string name;
  Pose2 start;                                     // world frame
  Eigen::Vector2d goal = Eigen::Vector2d::Zero();  // [m] world frame
  Footprint footprint{0.8, 0.4};
  MotionLimits limits{2.0, 1.5708, 2.0, 4.0};
  LidarSpec lidar;
  OdometrySpec odometry;
  ClockSpec clock;
  RadioSpec radio;
  bool joins_later = false;  // an event lets it appear

  /// The goal as the robot is told it: in its own odom frame, which begins where the robot does.
  Eigen::Vector2d goalInOdom() const { return start.inverse() * goal; }
};

enum class EventKind { kKill, kStall, kMute, kBlind, kJoin, kDoor };

struct Event {
  double time = 0.0;  // [s]
  EventKind kind = EventKind::kKill;
  std::size_t robot = 0;
  double duration = 0.0;                           // [s] of stall, mute and blind
  Eigen::Vector2d from = Eigen::Vector2d::Zero();  // [m] ends of the door
  Eigen::Vector2d to = Eigen::Vector2d::Zero();    // [m]
  bool closed = false;                             // what the door becomes
};

/// A disc that goes along a path and back, blind, through anything.
struct MovingObstacleSpec {
  double radius = 0.3;  // [m]
  double speed = 1.0;   // [m/s]
  std::vector<Eigen::Vector2d> path;
};

enum class Judge { kTruth, kOdometry };

/// A scenario file, all defaults filled in.
struct Scenario {
  std::string name;       // of the file
  std::string file;       // as it was given
  std::string map;        // path of the world's yaml
  double duration = 0.0;  // [s]
  std::uint64_t seed = 1;
  double goal_tolerance = 0.3;  // [m]
  Judge judge = Judge::kTruth;
  std::vector<RobotSpec> robots;
  std::vector<Event> events;  // by time
  std::vector<MovingObstacleSpec> obstacles;
};

}  // namespace parley::sim

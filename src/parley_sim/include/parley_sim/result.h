// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "parley_sim/fleet_runner.h"

namespace parley::sim {

/// What has no value has none here, and is null in the file.
struct RobotResult {
  std::string name;
  bool reached = false;
  std::optional<double> time;           // [s] from its appearance to its arrival
  double length = 0.0;                  // [m]
  double straight = 0.0;                // [m]
  std::optional<double> shortest;       // [m]
  std::optional<double> mean_speed;     // [m/s]
  std::optional<double> min_clearance;  // [m]
  double stopped = 0.0;                 // [s]
  int escapes = 0, replans = 0, route_switches = 0;
  std::string final_state;
  std::int64_t tx_bytes = 0, rx_bytes = 0;
};

struct StageTiming {
  std::optional<double> p50, p99;  // [ms]
};

/// When and where a collision or a touch began.
struct IncidentResult {
  double time = 0.0;                                   // [s]
  std::string kind;                                    // static, robot, moving or touched
  std::string robot;                                   // name
  std::string other;                                   // name of the other robot, if it is one
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // [m] of the robot, world frame
};

struct Result {
  std::string scenario;
  std::uint64_t seed = 0;
  std::string variant;
  bool success = false;
  int static_collisions = 0, robot_collisions = 0, moving_collisions = 0, touched = 0;
  std::optional<double> mean_time, mean_length, path_optimality, mean_regret;  // over robots that reached
  std::vector<RobotResult> robots;
  std::vector<IncidentResult> incidents;
  double bytes_per_second_per_robot = 0.0;
  std::int64_t map_bytes = 0, keyframe_bytes = 0, trajectory_bytes = 0, beacon_bytes = 0, conflict_bytes = 0, overhead_bytes = 0;
  std::optional<double> delivered;  // [-]
  int encounters = 0, localized = 0, false_pairs = 0;
  std::optional<double> translation_error_p50, translation_error_max;  // [m] at confirmation
  std::optional<double> rotation_error_p50, rotation_error_max;        // [rad]
  std::optional<double> seconds_to_localize_p50;                       // [s]
  std::array<StageTiming, kStageNames.size()> timing;
  double simulated = 0.0;  // [s]
  double wall = 0.0;       // [s]

  int collisions() const { return static_collisions + robot_collisions + moving_collisions; }
  int reachedCount() const;
};

/// `wall`: how long the run took. [s]
Result resultOf(const FleetRunner& runner, const std::string& variant, double wall);

/// The result as a JSON text; the same run gives the same text but for `wall` and `timing_ms`.
std::string toJson(const Result& result);

/// One line for people.
std::string summaryOf(const Result& result);

}  // namespace parley::sim

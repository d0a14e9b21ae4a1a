// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "parley_control/controller.h"
#include "parley_exchange/exchange_options.h"
#include "parley_exchange/team_key.h"
#include "parley_geometry/footprint.h"
#include "parley_geometry/motion.h"
#include "parley_lidar/lidar_stage.h"
#include "parley_planner/planner.h"
#include "parley_relative_localization/relative_localization_options.h"
#include "parley_topology/topology.h"

namespace parley {

/// What of the whole is switched on; the rows of the paper's tables.
enum class Variant { kFull, kNoSharing, kNoConflictResolution, kReactive };

/// Rates and delays of the glue between the stages.
struct WiringOptions {
  double topology_rate = 5.0;        // [Hz]
  double plan_rate = 10.0;           // [Hz]
  double plan_delay = 0.05;          // [s]
  double local_map_size = 10.0;      // [m]
  double jump_distance = 1.0;        // [m]
  double jump_angle = 1.0;           // [rad]
  double correction_distance = 0.1;  // [m]
  double correction_angle = 0.03;    // [rad]
  double arrival_hysteresis = 0.2;   // [m]

  template <class Visitor>
  void visit(Visitor& v) {
    v.number("topology_rate", topology_rate, "Hz", 0.5, 50.0, "how often contours, graph and route are brought up to date");
    v.number("plan_rate", plan_rate, "Hz", 1.0, 50.0, "how often the planner looks at the world");
    v.number("plan_delay", plan_delay, "s", 0.0, 1.0, "a plan is used this long after the data it was made from");
    v.number("local_map_size", local_map_size, "m", 4.0, 40.0, "side of the window of the map that the planner sees");
    v.number("jump_distance", jump_distance, "m", 0.1, 100.0, "odometry that moves further between two readings has jumped");
    v.number("jump_angle", jump_angle, "rad", 0.1, 3.2, "odometry that turns further between two readings has jumped");
    v.number("correction_distance", correction_distance, "m", 0.02, 100.0,
             "odometry that is further off than twist and limits explain was corrected");
    v.number("correction_angle", correction_angle, "rad", 0.005, 3.2, "odometry that turned so much more was corrected");
    v.number("arrival_hysteresis", arrival_hysteresis, "m", 0.0, 5.0,
             "an arrived robot drives again when it is pushed this far beyond the tolerance");
  }
};

/// Everything that makes one robot.
struct RobotOptions {
  std::string name;
  Footprint footprint;
  MotionLimits limits;
  LidarMount mount;
  double goal_tolerance = 0.3;  // [m]
  Variant variant = Variant::kFull;
  TeamKey key{};           // what all of a team share
  std::uint32_t boot = 1;  // [-] below 2^24; higher at each start
  WiringOptions wiring;
  LidarOptions lidar;
  TopologyOptions topology;
  RelativeLocalizationOptions relative_localization;
  ExchangeOptions exchange;
  PlannerOptions planner;
  ControlOptions control;
};

/// All problems of a robot's options; empty if it can be built.
std::vector<std::string> checkRobot(const RobotOptions& options);

}  // namespace parley

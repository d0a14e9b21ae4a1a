// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "parley_geometry/motion.h"
#include "parley_geometry/status.h"
#include "parley_sim/localization_judge.h"
#include "parley_sim/scenario.h"
#include "parley_sim/simulated_robot.h"

namespace parley::sim {

/// The stages whose time is reported, in the order of `BrainOutput::stage_seconds`.
constexpr std::array<const char*, 8> kStageNames{"lidar",      "map_fusion", "topology", "route", "relative_localization",
                                                 "local_plan", "trajectory", "control"};

/// Payload bytes of what a robot has sent, by kind. [byte]
struct SentBytes {
  std::int64_t map = 0, keyframe = 0, trajectory = 0, beacon = 0, conflict = 0;
};

/// What a robot's mind answers to what its sensors say.
struct BrainOutput {
  Twist2 twist;
  DriveState state = DriveState::kStopped;
  std::vector<Payload> packets;                                                                          // to broadcast
  std::array<double, kStageNames.size()> stage_seconds{-1.0, -1.0, -1.0, -1.0, -1.0, -1.0, -1.0, -1.0};  // negative: did not run
  int replans = 0;  // [-] since the start, as the two below
  int route_switches = 0;
  int escapes = 0;
  std::optional<Eigen::Vector2d> escape;  // [m] in base_link: where it goes to make room
  std::vector<PeerBelief> beliefs;        // confirmed relative poses
  SentBytes sent;                         // since the start
};

/// The mind of one robot. An interface, so that the runner can be tested with minds that do one simple thing.
class Brain {
 public:
  virtual ~Brain() = default;
  virtual BrainOutput step(const SensorReadings& readings) = 0;
  /// What it knew, wanted and decided in the last step, as text; a picture of it goes to a file unless that is empty.
  virtual std::string explain(const std::string& /*picture*/) const { return {}; }
};

/// Makes the mind of a robot when it appears in the world; throws InputError if it cannot be configured.
using BrainFactory = std::function<std::unique_ptr<Brain>(const RobotSpec& spec, double goal_tolerance)>;

}  // namespace parley::sim

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "parley_sim/brain.h"
#include "parley_sim/simulation.h"

namespace parley::sim {

/// Couples a simulation with the minds of its robots, in lockstep.
class FleetRunner {
 public:
  /// `world` has to outlive the runner. Throws InputError where a robot cannot be made.
  FleetRunner(const Scenario& scenario, const World& world, BrainFactory factory);

  /// One step of the simulation, then every robot's mind in the order of the scenario.
  void step();
  bool finished() const { return simulation_.finished(); }

  const Simulation& simulation() const { return simulation_; }
  /// What the robots got in the last step.
  const std::vector<SensorReadings>& readings() const { return readings_; }
  /// What a robot's mind answered last.
  const BrainOutput& output(std::size_t robot) const { return outputs_[robot]; }
  DriveState state(std::size_t robot) const;
  const LocalizationJudge& localization() const { return localization_; }
  /// Null before the robot has joined.
  const Brain* brain(std::size_t robot) const { return brains_[robot].get(); }
  /// Wall time of every run of a stage, all robots together. [s]
  const std::array<std::vector<float>, kStageNames.size()>& stageTimes() const { return stage_times_; }

 private:
  void think(std::size_t robot);
  void judgeLocalization();

  Simulation simulation_;
  LocalizationJudge localization_;
  long steps_ = 0;
  BrainFactory factory_;
  std::vector<std::unique_ptr<Brain>> brains_;  // null before the robot has joined
  std::vector<SensorReadings> readings_;
  std::vector<BrainOutput> outputs_;
  std::array<std::vector<float>, kStageNames.size()> stage_times_;
};

}  // namespace parley::sim

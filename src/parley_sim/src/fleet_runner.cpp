// SPDX-License-Identifier: BSD-3-Clause
#include "parley_sim/fleet_runner.h"

namespace parley::sim {
namespace {

constexpr long kStepsPerJudgement = 10;

std::vector<std::string> namesOf(const Scenario& scenario) {
  std::vector<std::string> names;
  for (const RobotSpec& robot : scenario.robots) names.push_back(robot.name);
  return names;
}

}  // namespace

FleetRunner::FleetRunner(const Scenario& scenario, const World& world, BrainFactory factory)
    : simulation_(scenario, world),
      localization_(namesOf(scenario)),
      factory_(std::move(factory)),
      brains_(scenario.robots.size()),
      readings_(scenario.robots.size()),
      outputs_(scenario.robots.size()) {
  // one of each kind is tried at once: what cannot be configured has to be said before the run, not at a late join
  for (const RobotSpec& robot : scenario.robots) factory_(robot, scenario.goal_tolerance);
}

void FleetRunner::step() {
  readings_ = simulation_.step();
  for (std::size_t robot = 0; robot < brains_.size(); ++robot) {
    if (readings_[robot].present) think(robot);
  }
  if (steps_++ % kStepsPerJudgement == 0) judgeLocalization();
}

void FleetRunner::judgeLocalization() {
  std::vector<std::optional<BelievedState>> states(brains_.size());
  for (std::size_t robot = 0; robot < brains_.size(); ++robot) {
    if (!brains_[robot]) continue;
    states[robot] = BelievedState{simulation_.truth().bodies[robot].state.pose, simulation_.robot(robot).believed(),
                                  &outputs_[robot].beliefs};
  }
  localization_.observe(simulation_.time(), states, simulation_.encounters());
}

void FleetRunner::think(std::size_t robot) {
  const Scenario& scenario = simulation_.scenario();
  if (!brains_[robot]) brains_[robot] = factory_(scenario.robots[robot], scenario.goal_tolerance);
  BrainOutput& output = outputs_[robot];
  output = brains_[robot]->step(readings_[robot]);
  simulation_.command(robot, output.twist);
  for (const Payload& packet : output.packets) simulation_.send(robot, packet);
  for (std::size_t stage = 0; stage < kStageNames.size(); ++stage) {
    const double seconds = output.stage_seconds[stage];
    if (seconds >= 0.0) stage_times_[stage].push_back(static_cast<float>(seconds));
  }
}

DriveState FleetRunner::state(std::size_t robot) const {
  return simulation_.robot(robot).dead() ? DriveState::kDead : outputs_[robot].state;
}

}  // namespace parley::sim

// SPDX-License-Identifier: BSD-3-Clause
#include "parley_sim/picture.h"

#include "drawing.h"
#include "parley_sim/input_error.h"

namespace parley::sim {
namespace {

constexpr long kSteps = 5;  // of the simulation between two points of a track

std::string legendOf(const FleetRunner& runner, std::size_t robot) {
  const RobotRecord& record = runner.simulation().referee().records()[robot];
  const std::string name = runner.simulation().scenario().robots[robot].name;
  return name + "  " +
         (record.reached ? oneDecimal(record.time) + " s, " + oneDecimal(record.length) + " m" : toString(runner.state(robot)));
}

void drawRobots(Drawing& drawing, const FleetRunner& runner, const std::vector<std::vector<Eigen::Vector2d>>& tracks) {
  const Scenario& scenario = runner.simulation().scenario();
  const Snapshot& truth = runner.simulation().truth();
  for (std::size_t i = 0; i < tracks.size(); ++i) drawing.track(tracks[i], i);
  for (std::size_t i = 0; i < scenario.robots.size(); ++i) {
    drawing.goal(scenario.robots[i].goal, scenario.goal_tolerance, i);
    drawing.start(scenario.robots[i].start.position(), i);
    if (truth.bodies[i].present) drawing.body(truth.bodies[i].box(), i);
  }
  for (std::size_t i = 0; i < scenario.robots.size(); ++i) {
    drawing.label(scenario.robots[i].start.position(), scenario.robots[i].name, i);
  }
}

std::string titleOf(const FleetRunner& runner) {
  const Simulation& simulation = runner.simulation();
  const auto incidents = static_cast<int>(simulation.referee().incidents().size()) - simulation.referee().touched();
  return simulation.scenario().name + ", seed " + std::to_string(simulation.scenario().seed) + ", " +
         oneDecimal(simulation.time()) + " s, " + std::to_string(incidents) + " collisions";
}

}  // namespace

void Picture::note(const FleetRunner& runner) {
  if (calls_++ % kSteps != 0) return;
  const std::vector<Body>& bodies = runner.simulation().truth().bodies;
  tracks_.resize(bodies.size());
  escapes_.resize(bodies.size(), 0);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies[i].present) tracks_[i].push_back(bodies[i].state.pose.position());
    const BrainOutput& output = runner.output(i);
    if (output.escapes == escapes_[i] || !output.escape) continue;
    escapes_[i] = output.escapes;
    escape_points_.emplace_back(i, bodies[i].state.pose * *output.escape);
  }
}

void Picture::write(const std::string& file, const FleetRunner& runner) const {
  const Simulation& simulation = runner.simulation();
  Drawing drawing(simulation.world(), tracks_.size());
  for (const Box& door : simulation.truth().doors) drawing.door(door);
  for (const MovingObstacleSpec& obstacle : simulation.scenario().obstacles) drawing.obstaclePath(obstacle.path, obstacle.radius);
  drawRobots(drawing, runner, tracks_);
  for (const auto& [robot, point] : escape_points_) drawing.escape(point, robot);
  for (const Encounter& encounter : simulation.encounters()) drawing.encounter(encounter.position);
  for (const Incident& incident : simulation.referee().incidents()) drawing.incident(incident.position, incident.touched);
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < tracks_.size(); ++i) lines.push_back(legendOf(runner, i));
  drawing.legend(titleOf(runner), lines);
  if (!drawing.save(file)) throw InputError("--picture: " + file + ": cannot be written");
}

}  // namespace parley::sim

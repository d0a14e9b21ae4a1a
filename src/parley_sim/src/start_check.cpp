// SPDX-License-Identifier: BSD-3-Clause
#include <string>

#include "parley_sim/input_error.h"
#include "parley_sim/scenario_loader.h"
#include "parley_sim/shapes.h"

namespace parley::sim {
namespace {

Box startOf(const RobotSpec& robot) { return boxAt(robot.start, robot.footprint.length, robot.footprint.width); }

/// What is wrong with the place where a robot starts; empty if nothing.
std::string faultOf(const Scenario& scenario, std::size_t index, const World& world) {
  const RobotSpec& robot = scenario.robots[index];
  if (!world.frame().contains(world.frame().cellOf(robot.start.position()))) return robot.name + " starts off the map";
  if (world.overlapsSolid(startOf(robot))) return robot.name + " starts in a wall";
  for (std::size_t other = 0; other < index && !robot.joins_later; ++other) {
    if (scenario.robots[other].joins_later) continue;
    if (overlap(startOf(robot), startOf(scenario.robots[other]))) {
      return robot.name + " starts in " + scenario.robots[other].name;
    }
  }
  return "";
}

}  // namespace

void checkStarts(const Scenario& scenario, const World& world) {
  for (std::size_t i = 0; i < scenario.robots.size(); ++i) {
    const std::string fault = faultOf(scenario, i, world);
    if (!fault.empty()) throw InputError(scenario.file + ": robots." + std::to_string(i) + ".start: " + fault);
  }
}

}  // namespace parley::sim

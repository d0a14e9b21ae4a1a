// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "parley_geometry/footprint.h"
#include "parley_robot/robot_stack.h"

namespace parley::sim {

/// What a robot knows, wants and has decided, line by line, in its own odom frame.
std::string explanationOf(const RobotStack& stack);

/// The same as a picture of 10 m around the robot, in its own odom frame: cells, scan, tracks, graph, route, path, committed
/// trajectory. False if the file cannot be written.
bool drawExplanation(const RobotStack& stack, const Footprint& footprint, const std::string& file);

}  // namespace parley::sim

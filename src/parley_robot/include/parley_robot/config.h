// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "parley_geometry/options.h"
#include "parley_robot/robot_options.h"

namespace parley {

/// Reads a flat YAML file of options; problems name file, key and reason.
struct OptionFile {
  OptionValues values;
  std::vector<std::string> problems;
};
OptionFile readOptionFile(const std::string& path);

/// Loads wiring.yaml, lidar.yaml, topology.yaml, planner.yaml and control.yaml from a folder into `options`; a file
/// that is missing leaves its stage as it is, a folder without any is a problem. Returns all problems.
std::vector<std::string> loadConfig(const std::string& directory, RobotOptions& options);

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "parley_sim/scenario_loader.h"

namespace parley::sim {

/// What fleet_run was asked for.
struct Arguments {
  bool help = false;
  bool quiet = false;
  std::string scenario;
  std::string variant = "full";
  std::vector<Override> overrides;                   // in the order in which they apply
  std::string config;                                // folder, empty: the defaults
  std::string json, trace, picture, bag, bag_robot;  // empty: not wanted
};

/// Throws InputError.
Arguments parseArguments(const std::vector<std::string>& words);

const char* usage();

}  // namespace parley::sim

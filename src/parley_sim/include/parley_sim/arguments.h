// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "parley_sim/scenario_loader.h"

namespace parley::sim {

/// A moment of a robot that somebody wants to understand.
struct Question {
  double time = 0.0;  // [s] simulated
  std::string robot;
};

/// What fleet_run was asked for.
struct Arguments {
  bool help = false;
  bool quiet = false;
  std::string scenario;
  std::string variant = "full";
  std::vector<Override> overrides;                   // in the order in which they apply
  std::string config;                                // folder, empty: the defaults
  std::string json, trace, picture, bag, bag_robot;  // empty: not wanted
  std::vector<Question> questions;
};

/// Throws InputError.
Arguments parseArguments(const std::vector<std::string>& words);

const char* usage();

}  // namespace parley::sim

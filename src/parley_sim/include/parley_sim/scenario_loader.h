// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "parley_sim/scenario.h"
#include "parley_sim/world.h"

namespace parley::sim {

/// A key's dotted path and its value as YAML text.
using Override = std::pair<std::string, std::string>;

/// Reads a scenario; `overrides` replace what the file says, in their order. Throws InputError.
Scenario loadScenario(const std::string& file, const std::vector<Override>& overrides = {});

/// Throws InputError where a robot starts off the map, in something solid, or in another robot.
void checkStarts(const Scenario& scenario, const World& world);

}  // namespace parley::sim

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "parley_sim/brain.h"

namespace parley::sim {

/// The names of the variants that `stackBrains` knows.
const std::vector<std::string>& variantNames();

/// Real robots: each mind is a RobotStack with the options of a configuration folder (empty: the defaults).
BrainFactory stackBrains(const std::string& config_directory, const std::string& variant);

}  // namespace parley::sim

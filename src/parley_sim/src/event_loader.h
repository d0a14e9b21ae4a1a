// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "parley_sim/scenario.h"
#include "yaml_section.h"

namespace parley::sim {

/// A scenario's events, sorted by time, with the names of robots resolved.
std::vector<Event> readEvents(const std::vector<YamlSection>& sections, const std::vector<RobotSpec>& robots);

}  // namespace parley::sim

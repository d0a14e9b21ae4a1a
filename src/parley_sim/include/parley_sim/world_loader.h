// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "parley_sim/world.h"

namespace parley::sim {

/// Reads a world in map_server's format: a YAML file that names an image. Throws InputError.
World loadWorld(const std::string& yaml_file);

}  // namespace parley::sim

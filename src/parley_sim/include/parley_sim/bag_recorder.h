// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "parley_sim/fleet_runner.h"

namespace parley::sim {

/// Called after every step of a run.
using StepObserver = std::function<void(const FleetRunner&)>;

/// Writes what one robot's topics would have held into a bag; the bag is complete when the observer is destroyed.
/// Throws InputError if the file cannot be written, or if this build cannot write bags.
StepObserver recordBag(const std::string& file, std::size_t robot);

}  // namespace parley::sim

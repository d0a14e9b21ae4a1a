// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "parley_sim/arguments.h"
#include "parley_sim/result.h"

namespace parley::sim {

/// Does what fleet_run was asked for. Throws InputError before the run starts if anything asked for is not usable.
Result runFleet(const Arguments& arguments);

}  // namespace parley::sim

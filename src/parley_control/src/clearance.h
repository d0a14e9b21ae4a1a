// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "parley_geometry/footprint.h"
#include "parley_geometry/scan.h"

namespace parley {

/// Whether the footprint comes nearer than `margin` to a return of the scan on its way through `sweep`, poses in the
/// present base frame. Where it is that near already, what counts is whether it comes nearer still: such a robot may
/// leave, or drive on along a wall.
bool touches(const std::vector<Pose2>& sweep, const ObstacleScan& scan, const Pose2& T_base_scan, const Footprint& footprint,
             double margin);

}  // namespace parley

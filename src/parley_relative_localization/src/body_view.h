// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "parley_geometry/footprint.h"
#include "parley_relative_localization/exchange_records.h"

namespace parley {

/// How a lidar would see a robot of that footprint: middle and width of what faces it. nullopt from inside or from so near
/// that it would be no blob.
std::optional<SightedBlob> viewOfBody(const Footprint& footprint, const Pose2& T_scan_body);

}  // namespace parley

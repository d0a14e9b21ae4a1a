// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "clearance_field.h"
#include "parley_topology/contour.h"
#include "tiled_map.h"

namespace parley {

/// Whether own sensing has looked through a part of a layer's outline since it was told: a stretch of it lies in seen
/// space, away from whatever is held occupied, and was looked at later.
bool isSeenThrough(TiledMap& map, const FieldShape& shape, const Pose2& T_odom_peer, const LayerContour& contour);

/// Forgets the cells along an outline that own sensing held occupied before a time and has not looked at since.
void forgetAlong(TiledMap& map, const Refuted& outline);

}  // namespace parley

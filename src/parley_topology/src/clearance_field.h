// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tiled_map.h"

namespace parley {

/// What the derived parts of the map are made with.
struct FieldShape {
  double grown_radius = 0.25;   // [m] contours are drawn at this distance from what is occupied
  double reach = 1.0;           // [m] distances are held up to this
  double layer_distance = 0.1;  // [m] a layer counts only this far from what own sensing has seen
};

/// Distance held in a byte, in metres.
inline double metersOf(std::uint8_t distance, double reach) { return distance * reach / kFarAway; }

/// Works out again what is fused, how far the next obstacle is and what is wide, passable or tentative, in the windows
/// whose cells have changed. Afterwards `changed_cells` is empty and `changed_field` has the blocks that differ.
void refreshField(TiledMap& map, const FieldShape& shape);

}  // namespace parley

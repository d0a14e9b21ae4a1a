// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "parley_topology/contour.h"
#include "tiled_map.h"

namespace parley {

/// Outlines of the cells that have `flag`, tile by tile in the order of rows and columns, simplified to about a cell.
std::vector<Contour> outlinesOf(const TiledMap& map, CellFlag flag);

}  // namespace parley

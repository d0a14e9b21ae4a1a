// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "clearance_field.h"
#include "tiled_map.h"

namespace parley {

/// The contours of the grown obstacles inside one tile (cv::findContours, then Douglas-Peucker), at `shape.grown_radius`
/// to a fraction of a cell. They depend on the cells of the tile and two around it and on nothing else, so that the graph
/// is a function of the map alone, whatever order it was learnt in.
std::vector<Chain> traceTile(const TiledMap& map, int tx, int ty, const FieldShape& shape, double simplify);

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "contour_tracer.h"
#include "layer_store.h"
#include "parley_topology/visibility_graph.h"

namespace parley {

/// The convex corners of a tile's chains. Where chains of two tiles meet, the corner belongs to the tile it lies in and
/// takes the direction of the outline from both. Provenance is that of the obstacle behind the corner.
std::vector<Vertex> cornersOf(const TiledMap& map, const Tile& tile, const FieldShape& shape, double simplify,
                              const LayerStore& layers);

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "parley_topology/topology_options.h"
#include "scan_raster.h"
#include "tiled_map.h"

namespace parley {

/// Votes cells in and out: adds what a scan says to each cell's evidence, and changes what the cell is held to be where
/// the evidence passes its thresholds. Notes the blocks that changed. `stamp` [s] is the scan's.
void addEvidence(TiledMap& map, const ScanImage& image, double stamp, const TopologyOptions& options);

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sight.h"
#include "tiled_map.h"

namespace parley {

/// A way over passable cells from start to goal, pulled tight; empty if there is none. The court of appeal for when the
/// graph has no way: works from both ends in turn, so that being shut in costs only as much as the smaller side, and
/// gives up without a way after `max_cells`. Unless `tube` is empty the way stays within `radius` [m] of it.
std::vector<Eigen::Vector2d> searchGrid(const TiledMap& map, const Sight& sight, const Eigen::Vector2d& start,
                                        const Eigen::Vector2d& goal, int max_cells, const std::vector<Eigen::Vector2d>& tube = {},
                                        double radius = 0.0);

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "tiled_map.h"

namespace parley {

/// How often a closed chain of points goes around a point, counter-clockwise positive.
int windingNumber(const std::vector<Eigen::Vector2d>& loop, const Eigen::Vector2d& point);

/// A point of each obstacle in each tile. [m]
std::vector<Eigen::Vector2d> obstaclePoints(const TiledMap& map);

/// Whether two ways with common ends pass all obstacles on the same sides: the loop out along one and back along the
/// other goes around none of their points.
bool sameClass(const std::vector<Eigen::Vector2d>& obstacles, const std::vector<Eigen::Vector2d>& a,
               const std::vector<Eigen::Vector2d>& b);

}  // namespace parley

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

/// The obstacle points that a loop out along one way and back along another goes around; the ways have common ends.
std::vector<Eigen::Vector2d> pointsBetween(const std::vector<Eigen::Vector2d>& obstacles, const std::vector<Eigen::Vector2d>& a,
                                           const std::vector<Eigen::Vector2d>& b);

/// Whether two ways with common ends pass all obstacles on the same sides: there are none between them.
bool sameClass(const std::vector<Eigen::Vector2d>& obstacles, const std::vector<Eigen::Vector2d>& a,
               const std::vector<Eigen::Vector2d>& b);

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "parley_sim/world.h"

namespace parley::sim {

/// The shortest way of a disc between two points of the true map, within 2 % and never shorter by more than 0.1 %;
/// nullopt where there is none.
std::optional<std::vector<Eigen::Vector2d>> shortestPath(const World& world, const Eigen::Vector2d& start,
                                                         const Eigen::Vector2d& goal, double radius);

/// Its length. [m]
std::optional<double> shortestLength(const World& world, const Eigen::Vector2d& start, const Eigen::Vector2d& goal,
                                     double radius);

}  // namespace parley::sim

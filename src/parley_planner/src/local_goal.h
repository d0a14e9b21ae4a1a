// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "parley_geometry/grid_frame.h"
#include "parley_geometry/route.h"

namespace parley {

/// The point of a route (of two points or more) `look_ahead` [m] on from where it is nearest to `here`, but not outside
/// `window` nor nearer than `rim` [m] to its edge.
Eigen::Vector2d localGoal(const Route& route, const Eigen::Vector2d& here, double look_ahead, const GridFrame& window,
                          double rim);

}  // namespace parley

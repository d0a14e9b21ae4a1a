// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "binned_scan.h"

namespace parley {

/// One point, the mean, for each square cell that has any (PCL's voxel grid).
std::vector<Eigen::Vector2f> thinned(const std::vector<ObstaclePoint>& points, double cell);

}  // namespace parley

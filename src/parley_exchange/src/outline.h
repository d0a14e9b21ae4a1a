// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "parley_exchange/records.h"
#include "parley_geometry/polygon.h"

namespace parley {

/// An outline in an anchor's frame, cut into contours that the wire can carry: on its grid, not too long, not touching
/// themselves. Empty if it reaches beyond what the grid covers, or has no extent on it.
std::vector<ContourBody> cutOutline(const Polygon& polygon, bool closed, bool hole, std::uint32_t anchor);

/// In the anchor's frame. [m]
Polygon polygonOf(const ContourBody& contour);

/// Least distance from a point to an outline's segments. [m]
double distanceTo(const Polygon& polygon, bool closed, const Eigen::Vector2d& point);

/// No vertex of either outline is further than `tolerance` [m] from the other.
bool agree(const Polygon& a, const Polygon& b, bool closed, double tolerance);

/// Vertices, and points between them so that no gap is longer than `spacing` [m]; at most 1000.
std::vector<Eigen::Vector2d> samplesOf(const Polygon& polygon, bool closed, double spacing);

}  // namespace parley

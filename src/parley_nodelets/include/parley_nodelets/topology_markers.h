// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <string>
#include <vector>

#include "parley_geometry/route.h"
#include "parley_topology/contour.h"
#include "parley_topology/visibility_graph.h"

namespace parley {

/// What RViz shows of the strategic layer: one marker each for contours, graph edges, graph vertices and route, so that
/// ids are stable and a message replaces what the one before drew. Each holds at most `most_points` points.
visualization_msgs::MarkerArray topologyMarkers(const std::vector<Contour>& contours, const VisibilityGraph& graph,
                                                const Route& route, double stamp, const std::string& odom_frame,
                                                std::size_t most_points);

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/OccupancyGrid.h>
#include <parley_msgs/Graph.h>

#include <optional>
#include <string>

#include "parley_geometry/local_map.h"
#include "parley_topology/visibility_graph.h"

namespace parley {

/// Unknown is -1, seen free 0, occupied 100.
nav_msgs::OccupancyGrid toMessage(const LocalMap& map, const std::string& odom_frame);

/// Below 0 is unknown, below 50 seen free. nullopt if sizes do not agree, something is not finite, or the grid is
/// turned.
std::optional<LocalMap> fromMessage(const nav_msgs::OccupancyGrid& message);

parley_msgs::Graph toMessage(const VisibilityGraph& graph, double stamp, const std::string& odom_frame);

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "parley_topology/visibility_graph.h"
#include "sight.h"

namespace parley {

/// A question to the graph. Start and goal are joined to it by sight, without limit of length.
struct RouteQuery {
  Eigen::Vector2d start = Eigen::Vector2d::Zero();  // [m] a passable point
  Eigen::Vector2d goal = Eigen::Vector2d::Zero();   // [m] a passable point
  std::vector<char> allowed;                        // by slot, corners that may be used; empty: all
};

/// The cheapest way, or none: `points` is empty.
struct FoundRoute {
  std::vector<Eigen::Vector2d> points;  // [m] start, corners, goal
  double length = 0.0;                  // [m]
  double cost = 0.0;                    // [m]
  double unknown_length = 0.0;          // [m]
  double narrowest = 0.0;               // [m]
  bool exists() const { return !points.empty(); }
};

/// A route along given points, measured.
FoundRoute measuredRoute(const Sight& sight, const std::vector<Eigen::Vector2d>& points);

/// A* with decrease-key. Edges to the start and to the goal are looked at only when the search gets to them.
FoundRoute searchAstar(VisibilityGraph& graph, const Sight& sight, const RouteQuery& query);

/// The paper's depth-first search, as branch and bound: optimal too unless it has to stop after `max_expansions`.
FoundRoute searchDepthFirst(VisibilityGraph& graph, const Sight& sight, const RouteQuery& query, int max_expansions);

}  // namespace parley

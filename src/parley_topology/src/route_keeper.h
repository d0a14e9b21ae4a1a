// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "parley_geometry/route.h"
#include "route_search.h"

namespace parley {

/// Answers where to go, and stands by the answer: keeps the side on which obstacles are passed unless the way is shut or
/// another is cheaper by more than a penalty. Along a best route costs fall by what is driven, so on a map that does not
/// change no second switch can pay: going back takes news worth twice the penalty. Only obstacles that were known when the
/// last answer was given count: on which side to pass what has just come into sight was not decided before.
class RouteKeeper {
 public:
  explicit RouteKeeper(const TopologyOptions& options) : options_(options) {}

  Route route(const TiledMap& map, VisibilityGraph& graph, const Sight& sight, const Eigen::Vector2d& start,
              const Eigen::Vector2d& goal);
  void clear() { *this = RouteKeeper(options_); }

 private:
  bool passAlike(const TiledMap& map, const std::vector<Eigen::Vector2d>& a, const std::vector<Eigen::Vector2d>& b) const;
  FoundRoute mend(const TiledMap& map, VisibilityGraph& graph, const Sight& sight, const RouteQuery& query,
                  const std::vector<Eigen::Vector2d>& held) const;
  FoundRoute search(VisibilityGraph& graph, const Sight& sight, const RouteQuery& query) const;
  FoundRoute choose(const TiledMap& map, VisibilityGraph& graph, const Sight& sight, const RouteQuery& query);

  TopologyOptions options_;
  std::vector<Eigen::Vector2d> committed_;  // [m] the way last answered; empty if none
  std::vector<Eigen::Vector2d> obstacles_;  // [m] points of those that were known then
  Eigen::Vector2d goal_ = Eigen::Vector2d::Zero();
  bool has_goal_ = false;
  int switches_ = 0;
};

}  // namespace parley

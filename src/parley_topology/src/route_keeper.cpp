// SPDX-License-Identifier: BSD-3-Clause
#include "route_keeper.h"

#include "grid_search.h"
#include "homotopy.h"
#include "parley_geometry/polygon.h"

namespace parley {
namespace {

constexpr double kSameGoal = 0.05;        // [m] a goal further from the last is another goal
constexpr double kUnknownAllowed = 0.15;  // [m] of unseen cells on a route that counts as known: gaps between rays

/// By slot, whether a corner is within `radius` of a way.
std::vector<char> tubeAround(const std::vector<Eigen::Vector2d>& way, double radius, const VisibilityGraph& graph) {
  std::vector<char> inside(static_cast<std::size_t>(graph.slotCount()), 0);
  for (int slot = 0; slot < graph.slotCount(); ++slot) {
    if (!graph.has(slot)) continue;
    const Eigen::Vector2d& p = graph.vertex(slot).position;
    for (std::size_t i = 0; i + 1 < way.size(); ++i) {
      if (pointSegmentDistance(p, way[i], way[i + 1]) > radius) continue;
      inside[static_cast<std::size_t>(slot)] = 1;
      break;
    }
  }
  return inside;
}

/// Whether something occupied is at or beside a point. A side of what has gone is no side.
bool isStillThere(const TiledMap& map, const Eigen::Vector2d& p) {
  const int cx = map.cellOf(p.x()), cy = map.cellOf(p.y());
  for (int y = cy - 1; y <= cy + 1; ++y) {
    for (int x = cx - 1; x <= cx + 1; ++x) {
      if (map.flags(x, y) & kFused) return true;
    }
  }
  return false;
}

}  // namespace

/// Whether two ways pass all obstacles that were known, and are still there, on the same sides.
bool RouteKeeper::passAlike(const TiledMap& map, const std::vector<Eigen::Vector2d>& a,
                            const std::vector<Eigen::Vector2d>& b) const {
  const std::vector<Eigen::Vector2d> between = pointsBetween(obstacles_, a, b);
  return std::none_of(between.begin(), between.end(), [&](const Eigen::Vector2d& p) { return isStillThere(map, p); });
}

FoundRoute RouteKeeper::search(VisibilityGraph& graph, const Sight& sight, const RouteQuery& query) const {
  if (options_.search == "depth_first") return searchDepthFirst(graph, sight, query, options_.max_expansions);
  return searchAstar(graph, sight, query);
}

FoundRoute RouteKeeper::choose(const TiledMap& map, VisibilityGraph& graph, const Sight& sight, const RouteQuery& query) {
  FoundRoute best = search(graph, sight, query);
  if (!best.exists()) {  // the graph has no edges longer than its limit: nothing is called shut on its word alone
    best = measuredRoute(sight, searchGrid(map, sight, query.start, query.goal, options_.max_flood));
  }
  if (committed_.empty() || !best.exists()) return best;
  std::vector<Eigen::Vector2d> held = committed_;  // from here back onto it; the spur encloses nothing
  held.insert(held.begin(), query.start);
  held.back() = query.goal;
  if (passAlike(map, held, best.points)) return best;

  FoundRoute mended = mend(map, graph, sight, query, held);
  const bool open = mended.exists() && passAlike(map, held, mended.points);
  const double penalty = options_.switch_penalty + options_.switch_ratio * mended.cost;
  if (open && best.cost + penalty >= mended.cost) return mended;
  ++switches_;
  return best;
}

/// The best way near the one held; over the cells where the graph has none, before that is called shut.
FoundRoute RouteKeeper::mend(const TiledMap& map, VisibilityGraph& graph, const Sight& sight, const RouteQuery& query,
                             const std::vector<Eigen::Vector2d>& held) const {
  RouteQuery mending = query;
  mending.allowed = tubeAround(held, options_.class_tube, graph);
  FoundRoute mended = search(graph, sight, mending);
  if (mended.exists() && passAlike(map, held, mended.points)) return mended;
  return measuredRoute(sight, searchGrid(map, sight, query.start, query.goal, options_.max_flood, held, options_.class_tube));
}

Route RouteKeeper::route(const TiledMap& map, VisibilityGraph& graph, const Sight& sight, const Eigen::Vector2d& start,
                         const Eigen::Vector2d& goal) {
  if (!has_goal_ || (goal - goal_).norm() > kSameGoal) {
    clear();
    goal_ = goal;
    has_goal_ = true;
  }
  Route route;
  route.verdict = RouteVerdict::kUnreachableAsKnown;
  std::optional<Eigen::Vector2d> from = sight.nearestWith(kWide, start, options_.start_tolerance);
  if (!from) from = sight.nearestWith(kPassable, start, options_.start_tolerance);
  const std::optional<Eigen::Vector2d> to = sight.nearestWith(kPassable, goal, options_.goal_tolerance);
  FoundRoute found;
  if (from && to) found = choose(map, graph, sight, {*from, *to, {}});
  committed_ = found.points;
  obstacles_ = obstaclePoints(map);
  route.switches = switches_;
  if (!found.exists()) return route;
  route.points = found.points;
  route.length = found.length;
  route.cost = found.cost;
  route.narrowest = found.narrowest;
  const double detour = (*from - start).norm();
  if (detour > 0.0) route.points.insert(route.points.begin(), start);
  route.length += detour;
  route.cost += detour;
  route.verdict = found.unknown_length > kUnknownAllowed ? RouteVerdict::kThroughUnknown : RouteVerdict::kThroughKnown;
  return route;
}

}  // namespace parley

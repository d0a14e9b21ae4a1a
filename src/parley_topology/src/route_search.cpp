// SPDX-License-Identifier: BSD-3-Clause
#include "route_search.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "indexed_heap.h"

namespace parley {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kTangentSlack = 0.15;  // [-] as for edges between corners
constexpr int kFromStart = -1;
constexpr int kNoParent = -2;

/// The graph with start and goal in it. The goal's number is one past the slots.
class SearchSpace {
 public:
  SearchSpace(VisibilityGraph& graph, const Sight& sight, const RouteQuery& query)
      : graph_(graph), sight_(sight), query_(query) {}

  int goal() const { return graph_.slotCount(); }
  std::size_t size() const { return static_cast<std::size_t>(graph_.slotCount()) + 1; }
  bool usable(int slot) const {
    return graph_.has(slot) && (query_.allowed.empty() || query_.allowed[static_cast<std::size_t>(slot)]);
  }
  const Eigen::Vector2d& position(int slot) const { return slot == goal() ? query_.goal : graph_.vertex(slot).position; }
  double fromStart(int slot) const { return (position(slot) - query_.start).norm(); }
  double toGoal(int slot) const { return (position(slot) - query_.goal).norm(); }

  /// The edge from the start to a corner or the goal.
  std::optional<Edge> edgeFromStart(int slot) const {
    return slot == goal() || isTangentTo(slot, query_.start) ? sight_.look(query_.start, position(slot)) : std::nullopt;
  }
  std::optional<Edge> edgeToGoal(int slot) const {
    return isTangentTo(slot, query_.goal) ? sight_.look(position(slot), query_.goal) : std::nullopt;
  }

  /// The route along `parents` to the goal.
  FoundRoute trace(const std::vector<int>& parents) const {
    std::vector<Eigen::Vector2d> points;
    for (int node = goal(); node != kFromStart; node = parents[static_cast<std::size_t>(node)]) points.push_back(position(node));
    points.push_back(query_.start);
    std::reverse(points.begin(), points.end());
    return measuredRoute(sight_, points);
  }

  const std::vector<VisibilityGraph::Link>& links(int slot) const { return graph_.links(slot); }
  /// What the cost of an edge cannot be below: cheap.
  double leastCost(int edge) const { return graph_.edge(edge).length; }
  double cost(int edge) const {
    measureEdge(graph_, edge, sight_);
    return graph_.edge(edge).cost;
  }

 private:
  bool isTangentTo(int slot, const Eigen::Vector2d& point) const {
    const Eigen::Vector2d way = point - position(slot);
    const double length = way.norm();
    return length < 1e-6 || isTangent(graph_.vertex(slot), way / length, kTangentSlack);
  }

  VisibilityGraph& graph_;
  const Sight& sight_;
  const RouteQuery& query_;
};

class Astar {
 public:
  explicit Astar(const SearchSpace& space)
      : space_(space), cost_(space.size(), kInfinity), parent_(space.size(), kNoParent), heap_(space.size()) {}

  FoundRoute search() {
    gatherStarts();
    while (true) {
      const double next_start = starts_.empty() ? kInfinity : starts_.front().first;
      const double next_node = heap_.empty() ? kInfinity : heap_.leastKey();
      if (next_start == kInfinity && next_node == kInfinity) return {};
      if (next_start < next_node) {
        tryStart();
        continue;
      }
      const int node = heap_.pop();
      if (node == space_.goal()) return space_.trace(parent_);
      expand(node);
    }
  }

 private:
  using Start = std::pair<double, int>;  // least possible cost through it, node

  void gatherStarts() {
    starts_.reserve(space_.size());
    for (int slot = 0; slot < space_.goal(); ++slot) {
      if (space_.usable(slot)) starts_.emplace_back(space_.fromStart(slot) + space_.toGoal(slot), slot);
    }
    starts_.emplace_back(space_.fromStart(space_.goal()), space_.goal());
    std::make_heap(starts_.begin(), starts_.end(), std::greater<Start>());
  }

  void tryStart() {
    std::pop_heap(starts_.begin(), starts_.end(), std::greater<Start>());
    const int node = starts_.back().second;
    starts_.pop_back();
    if (cost_[static_cast<std::size_t>(node)] <= space_.fromStart(node)) return;
    if (const std::optional<Edge> edge = space_.edgeFromStart(node)) relax(node, kFromStart, edge->cost);
  }

  void expand(int node) {
    const double so_far = cost_[static_cast<std::size_t>(node)];
    for (const VisibilityGraph::Link& link : space_.links(node)) {
      if (!space_.usable(link.to) || so_far + space_.leastCost(link.edge) >= cost_[static_cast<std::size_t>(link.to)]) continue;
      relax(link.to, node, so_far + space_.cost(link.edge));
    }
    if (so_far + space_.toGoal(node) >= cost_[static_cast<std::size_t>(space_.goal())]) return;
    if (const std::optional<Edge> edge = space_.edgeToGoal(node)) relax(space_.goal(), node, so_far + edge->cost);
  }

  void relax(int node, int parent, double cost) {
    if (cost >= cost_[static_cast<std::size_t>(node)]) return;
    cost_[static_cast<std::size_t>(node)] = cost;
    parent_[static_cast<std::size_t>(node)] = parent;
    heap_.put(node, cost + space_.toGoal(node));
  }

  const SearchSpace& space_;
  std::vector<double> cost_;
  std::vector<int> parent_;
  IndexedHeap heap_;
  std::vector<Start> starts_;
};

/// Depth first, the most promising branch first; cut where a corner was reached cheaper before, or where even the straight
/// line to the goal would make the way dearer than the best known.
class DepthFirst {
 public:
  DepthFirst(const SearchSpace& space, int max_expansions)
      : space_(space), expansions_left_(max_expansions), cost_(space.size(), kInfinity), parent_(space.size(), kNoParent) {}

  FoundRoute search() {
    std::vector<Branch> branches;
    for (int node = 0; node <= space_.goal(); ++node) {
      if (node != space_.goal() && !space_.usable(node)) continue;
      if (const std::optional<Edge> edge = space_.edgeFromStart(node)) branches.push_back({edge->cost, node, kFromStart});
    }
    push(branches);
    while (!stack_.empty() && expansions_left_ > 0) {
      const Branch branch = stack_.back();
      stack_.pop_back();
      follow(branch);
    }
    return best_parents_.empty() ? FoundRoute{} : space_.trace(best_parents_);
  }

 private:
  struct Branch {
    double cost;  // [m] from the start
    int node, parent;
  };

  double bound(const Branch& branch) const { return branch.cost + space_.toGoal(branch.node); }

  void push(std::vector<Branch>& branches) {
    std::sort(branches.begin(), branches.end(), [this](const Branch& a, const Branch& b) {
      const double bound_a = bound(a), bound_b = bound(b);
      return bound_a != bound_b ? bound_a > bound_b : a.node > b.node;
    });
    stack_.insert(stack_.end(), branches.begin(), branches.end());
  }

  void follow(const Branch& branch) {
    const auto node = static_cast<std::size_t>(branch.node);
    if (branch.cost >= cost_[node] || bound(branch) >= cost_[static_cast<std::size_t>(space_.goal())]) return;
    --expansions_left_;
    cost_[node] = branch.cost;
    parent_[node] = branch.parent;
    if (branch.node == space_.goal()) {
      best_parents_ = parent_;  // parents on this branch are those of the stack's way down
      return;
    }
    std::vector<Branch> branches;
    for (const VisibilityGraph::Link& link : space_.links(branch.node)) {
      if (space_.usable(link.to)) branches.push_back({branch.cost + space_.cost(link.edge), link.to, branch.node});
    }
    if (const std::optional<Edge> edge = space_.edgeToGoal(branch.node)) {
      branches.push_back({branch.cost + edge->cost, space_.goal(), branch.node});
    }
    push(branches);
  }

  const SearchSpace& space_;
  int expansions_left_;
  std::vector<double> cost_;
  std::vector<int> parent_;
  std::vector<int> best_parents_;
  std::vector<Branch> stack_;
};

}  // namespace

FoundRoute measuredRoute(const Sight& sight, const std::vector<Eigen::Vector2d>& points) {
  FoundRoute route;
  route.points = points;
  route.narrowest = kInfinity;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Edge edge = sight.measure(points[i], points[i + 1]);
    route.length += edge.length;
    route.cost += edge.cost;
    route.unknown_length += edge.unknown_length;
    route.narrowest = std::min(route.narrowest, edge.clearance);
  }
  return route;
}

FoundRoute searchAstar(VisibilityGraph& graph, const Sight& sight, const RouteQuery& query) {
  return Astar(SearchSpace(graph, sight, query)).search();
}

FoundRoute searchDepthFirst(VisibilityGraph& graph, const Sight& sight, const RouteQuery& query, int max_expansions) {
  return DepthFirst(SearchSpace(graph, sight, query), max_expansions).search();
}

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#include "path_search.h"

#include <algorithm>
#include <cmath>
#include <queue>

#include "parley_geometry/polygon.h"

namespace parley {

namespace {

constexpr int kStride = 2;             // [cells] lattice spacing
constexpr double kStartRelief = 0.4;   // [m] around the start, where the robot may already be too near
constexpr double kKeepDistance = 0.2;  // [m] lattice points this near to the previous path keep it
constexpr double kNearGoal = 0.6;      // [m] a place so near to a closed goal will do
constexpr float kInfinity = 1e30F;

struct Entry {
  float estimate;  // [m] cost so far and at least to come
  int node;
  bool operator>(const Entry& other) const { return estimate != other.estimate ? estimate > other.estimate : node > other.node; }
};

/// The search's lattice: one node for each block of kStride x kStride cells.
class Lattice {
 public:
  Lattice(const Surroundings& surroundings, const Eigen::Vector2d& start, const Path& previous, const PathSearchOptions& options)
      : field_(surroundings.obstacles()), unseen_(surroundings.unseen()), frame_(field_.frame()), options_(options) {
    frame_.width /= kStride;
    frame_.height /= kStride;
    frame_.resolution *= kStride;
    kept_.assign(size(), 0);
    for (const Eigen::Vector2d& p : previous) keepAround(p);
    start_ = start;
  }

  std::size_t size() const { return static_cast<std::size_t>(frame_.width * frame_.height); }
  const GridFrame& frame() const { return frame_; }
  int width() const { return frame_.width; }
  Eigen::Vector2d position(int node) const { return frame_.centerOf({node % frame_.width, node / frame_.width}); }
  int nodeAt(const Eigen::Vector2d& p) const {
    const Eigen::Vector2i cell = frame_.cellOf(p);
    return frame_.indexOf({std::clamp(cell.x(), 0, frame_.width - 1), std::clamp(cell.y(), 0, frame_.height - 1)});
  }

  /// Cost of a metre at a node, negative where it is closed. The roomiest of a node's cells speaks for it: gaps
  /// narrower than the lattice stay open, and the smoothing finds their middle.
  float costAt(int node) const {
    const int x = node % frame_.width * kStride, y = node / frame_.width * kStride;
    const float clearance = std::max(std::max(field_.atCell(x, y), field_.atCell(x + 1, y)),
                                     std::max(field_.atCell(x, y + 1), field_.atCell(x + 1, y + 1)));
    const auto least = static_cast<float>(options_.least_clearance);
    const auto comfort = static_cast<float>(std::max(options_.comfort_distance, options_.least_clearance + 0.01));
    if (clearance < least && !relieved(node, clearance)) return -1.0F;
    float cost = 1.0F;
    if (clearance < comfort) {
      const float lack = std::min(1.0F, (comfort - clearance) / (comfort - least));
      cost += static_cast<float>(options_.clearance_weight) * lack * lack;
    }
    if (clearance < least) cost += 10.0F;
    if (unseen_.atCell(x, y) <= 0.0F) cost *= static_cast<float>(options_.unknown_cost);
    if (kept_[static_cast<std::size_t>(node)]) cost *= static_cast<float>(options_.keep_discount);
    return cost;
  }

 private:
  bool relieved(int node, float clearance) const { return clearance > 0.02F && (position(node) - start_).norm() < kStartRelief; }
  void keepAround(const Eigen::Vector2d& p) {
    const int reach = static_cast<int>(kKeepDistance / frame_.resolution);
    const Eigen::Vector2i middle = frame_.cellOf(p);
    for (int dy = -reach; dy <= reach; ++dy) {
      for (int dx = -reach; dx <= reach; ++dx) {
        const Eigen::Vector2i cell = middle + Eigen::Vector2i(dx, dy);
        if (frame_.contains(cell)) kept_[static_cast<std::size_t>(frame_.indexOf(cell))] = 1;
      }
    }
  }

  const DistanceField& field_;
  const DistanceField& unseen_;
  GridFrame frame_;
  const PathSearchOptions& options_;
  std::vector<unsigned char> kept_;
  Eigen::Vector2d start_;
};

/// Dijkstra with an octile estimate; stops at the goal.
class Search {
 public:
  Search(const Lattice& lattice, int start, int goal, double keep_discount)
      : lattice_(lattice), goal_(goal), least_cost_(static_cast<float>(keep_discount)) {
    costs_.assign(lattice.size(), kInfinity);
    metres_.assign(lattice.size(), kInfinity);
    parents_.assign(lattice.size(), -1);
    costs_[static_cast<std::size_t>(start)] = 0.0F;
    open_.push({estimate(start), start});
    nearest_ = start;
    while (!open_.empty() && !reached_) step();
  }

  bool reached() const { return reached_; }
  /// Lattice points from the start to the goal or to what is nearest to it.
  Path path() const { return pathTo(reached_ ? goal_ : nearest_); }
  /// Lattice points to the furthest point of a route that was reached; empty if none was.
  Path pathAlong(const Path& route) const {
    for (auto p = route.rbegin(); p != route.rend(); ++p) {
      const int node = lattice_.nodeAt(*p);
      if (costs_[static_cast<std::size_t>(node)] < kInfinity) return pathTo(node);
    }
    return {};
  }

 private:
  Path pathTo(int last) const {
    Path points;
    for (int node = last; node >= 0; node = parents_[static_cast<std::size_t>(node)]) points.push_back(lattice_.position(node));
    std::reverse(points.begin(), points.end());
    return points;
  }

  float estimate(int node) const {
    const int w = lattice_.width();
    const int dx = std::abs(node % w - goal_ % w), dy = std::abs(node / w - goal_ / w);
    const int diagonal = std::min(dx, dy), straight = std::max(dx, dy) - diagonal;
    return least_cost_ * static_cast<float>(lattice_.frame().resolution) *
           (static_cast<float>(straight) + 1.41421356F * static_cast<float>(diagonal));
  }

  void step() {
    const Entry entry = open_.top();
    open_.pop();
    const auto index = static_cast<std::size_t>(entry.node);
    if (entry.estimate > costs_[index] + estimate(entry.node) + 1e-4F) return;  // a cheaper way was found meanwhile
    if (estimate(entry.node) < estimate(nearest_)) nearest_ = entry.node;
    if (entry.node == goal_) {
      reached_ = true;
      return;
    }
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        if (dx != 0 || dy != 0) relax(entry.node, dx, dy);
      }
    }
  }

  void relax(int node, int dx, int dy) {
    const int w = lattice_.width();
    const Eigen::Vector2i cell(node % w + dx, node / w + dy);
    if (!lattice_.frame().contains(cell)) return;
    const int next = lattice_.frame().indexOf(cell);
    const float length = static_cast<float>(lattice_.frame().resolution) * (dx != 0 && dy != 0 ? 1.41421356F : 1.0F);
    const float so_far = costs_[static_cast<std::size_t>(node)];
    if (so_far + least_cost_ * length >= costs_[static_cast<std::size_t>(next)]) return;
    float& metre = metres_[static_cast<std::size_t>(next)];
    if (metre == kInfinity) metre = lattice_.costAt(next);
    if (metre < 0.0F) return;
    const float cost = so_far + metre * length;
    if (cost >= costs_[static_cast<std::size_t>(next)]) return;
    costs_[static_cast<std::size_t>(next)] = cost;
    parents_[static_cast<std::size_t>(next)] = node;
    open_.push({cost + estimate(next), next});
  }

  const Lattice& lattice_;
  int goal_;
  float least_cost_;
  int nearest_ = -1;
  bool reached_ = false;
  std::vector<float> costs_;
  std::vector<float> metres_;  // costAt; kInfinity until asked for
  std::vector<int> parents_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> open_;
};

double leastClearance(const DistanceField& field, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const int steps = std::max(1, static_cast<int>(std::ceil((b - a).norm() / 0.05)));
  double least = 1e3;
  for (int i = 0; i <= steps; ++i) least = std::min(least, field.at(a + (b - a) * (static_cast<double>(i) / steps)));
  return least;
}

}  // namespace

FoundPath searchPath(const Surroundings& surroundings, const Eigen::Vector2d& start, const Eigen::Vector2d& goal,
                     const Path& previous, const PathSearchOptions& options, const Path& route) {
  const Lattice lattice(surroundings, start, previous, options);
  const Search search(lattice, lattice.nodeAt(start), lattice.nodeAt(goal), options.keep_discount);
  Path points = search.path();
  if (!search.reached() && (points.back() - goal).norm() > kNearGoal) {  // what is near as the crow flies may be behind a wall
    Path on_route = search.pathAlong(route);
    if (on_route.size() > 1 && (on_route.back() - start).norm() > kLeastAdvance) {
      on_route.front() = start;
      return {on_route, false};
    }
  }
  if (!search.reached() && (points.back() - goal).norm() > (start - goal).norm() - kLeastAdvance) return {};
  // The lattice points of the start and the goal give way to the real ones.
  points.front() = start;
  if (points.size() < 2) points.push_back(goal);
  if (search.reached()) points.back() = goal;
  return {points, search.reached()};
}

Path straightened(const Surroundings& surroundings, const Path& path, double comfort_distance) {
  if (path.size() < 3) return path;
  const DistanceField& field = surroundings.obstacles();
  Path result = {path.front()};
  std::size_t from = 0;
  while (from + 1 < path.size()) {
    std::size_t to = from + 1;
    double room = leastClearance(field, path[from], path[to]);
    for (std::size_t next = to + 1; next < path.size(); ++next) {
      room = std::min(room, field.at(path[next]));
      if (leastClearance(field, path[from], path[next]) < std::min(room - 0.01, comfort_distance)) break;
      to = next;
    }
    result.push_back(path[to]);
    from = to;
  }
  return result;
}

Path shortened(const Path& path, double by) {
  double left = pathLength(path) - by;
  if (left <= 0.0) return {};
  Path result = {path.front()};
  for (std::size_t i = 1; i < path.size() && left > 0.0; ++i) {
    const Eigen::Vector2d step = path[i] - path[i - 1];
    const double share = step.norm() > left ? left / step.norm() : 1.0;
    result.emplace_back(path[i - 1] + share * step);
    left -= step.norm();
  }
  return result;
}

Path resampled(const Path& path, double spacing) {
  const double length = pathLength(path);
  const int count = std::max(1, static_cast<int>(std::ceil(length / spacing)));
  Path result = {path.front()};
  double passed = 0.0;
  std::size_t segment = 0;
  for (int i = 1; i < count; ++i) {
    const double wanted = length * i / count;
    while (segment + 2 < path.size() && passed + (path[segment + 1] - path[segment]).norm() < wanted) {
      passed += (path[segment + 1] - path[segment]).norm();
      ++segment;
    }
    const Eigen::Vector2d step = path[segment + 1] - path[segment];
    const double fraction = step.norm() > 0.0 ? (wanted - passed) / step.norm() : 0.0;
    result.push_back(path[segment] + std::clamp(fraction, 0.0, 1.0) * step);
  }
  result.push_back(path.back());
  return result;
}

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#include "lattice_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace parley::sim {
namespace {

constexpr double kSpacing = 0.05;   // [m] about
constexpr double kRounding = 1e-6;  // [m]
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// One octant of the 32 directions; the others mirror it.
constexpr std::array<std::array<int, 2>, 5> kSteps{{{1, 0}, {1, 1}, {2, 1}, {3, 1}, {3, 2}}};

double spacingFor(double resolution) {
  if (resolution >= kSpacing) return resolution / std::ceil(resolution / kSpacing - kRounding);
  return resolution * std::floor(kSpacing / resolution + kRounding);
}

std::vector<Eigen::Vector2i> directions() {
  std::vector<Eigen::Vector2i> all;
  for (const auto& [a, b] : kSteps) {
    for (const Eigen::Vector2i& step : {Eigen::Vector2i(a, b), Eigen::Vector2i(b, a)}) {
      for (const int sx : {1, -1}) {
        for (const int sy : {1, -1}) all.emplace_back(sx * step.x(), sy * step.y());
      }
    }
  }
  std::sort(all.begin(), all.end(),
            [](const Eigen::Vector2i& p, const Eigen::Vector2i& q) { return p.x() != q.x() ? p.x() < q.x() : p.y() < q.y(); });
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

}  // namespace

LatticeSearch::LatticeSearch(const World& world, double radius)
    : world_(world),
      radius_(radius),
      spacing_(spacingFor(world.frame().resolution)),
      width_(static_cast<int>(std::lround(world.frame().size().x() / spacing_)) + 1),
      height_(static_cast<int>(std::lround(world.frame().size().y() / spacing_)) + 1),
      free_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), -1) {}

Eigen::Vector2d LatticeSearch::pointOf(int node) const {
  return world_.frame().origin + spacing_ * Eigen::Vector2d(node % width_, node / width_);
}

bool LatticeSearch::isFree(const Eigen::Vector2d& point) const {
  return world_.freeRadius(point) >= radius_ || world_.distanceToSolid(point, radius_ + kRounding) >= radius_ - kRounding;
}

bool LatticeSearch::isFree(int x, int y) {
  if (x < 0 || y < 0 || x >= width_ || y >= height_) return false;
  std::int8_t& known = free_[static_cast<std::size_t>(y * width_ + x)];
  if (known < 0) known = isFree(pointOf(y * width_ + x)) ? 1 : 0;
  return known == 1;
}

std::vector<int> LatticeSearch::nodesNear(const Eigen::Vector2d& point) {
  // A disc at both ends of so short a step is free in between: what lies there would have to be thinner than a point.
  const Eigen::Vector2d cell = (point - world_.frame().origin) / spacing_;
  const int x0 = static_cast<int>(std::floor(cell.x())), y0 = static_cast<int>(std::floor(cell.y()));
  std::vector<int> nodes;
  for (int y = y0 - 1; y <= y0 + 2; ++y) {
    for (int x = x0 - 1; x <= x0 + 2; ++x) {
      if (isFree(x, y)) nodes.push_back(y * width_ + x);
    }
  }
  return nodes;
}

void LatticeSearch::reach(int node, int parent, double cost, const Eigen::Vector2d& goal) {
  const std::size_t index = static_cast<std::size_t>(node);
  if (cost >= costs_[index]) return;
  costs_[index] = cost;
  parents_[index] = parent;
  open_.push_back({cost + (pointOf(node) - goal).norm(), cost, node});
  std::push_heap(open_.begin(), open_.end(), Later());
}

void LatticeSearch::expand(const Open& from, const Eigen::Vector2d& goal) {
  static const std::vector<Eigen::Vector2i> kDirections = directions();
  const int x = from.node % width_, y = from.node / width_;
  for (const Eigen::Vector2i& step : kDirections) {
    if (!isFree(x + step.x(), y + step.y())) continue;
    const double length = spacing_ * step.cast<double>().norm();
    reach((y + step.y()) * width_ + x + step.x(), from.node, from.cost + length, goal);
  }
}

std::vector<Eigen::Vector2d> LatticeSearch::trace(int last, const Eigen::Vector2d& start, const Eigen::Vector2d& goal) const {
  std::vector<Eigen::Vector2d> path{goal};
  for (int node = last; node >= 0; node = parents_[static_cast<std::size_t>(node)]) path.push_back(pointOf(node));
  path.push_back(start);
  std::reverse(path.begin(), path.end());
  return path;
}

std::optional<std::vector<Eigen::Vector2d>> LatticeSearch::path(const Eigen::Vector2d& start, const Eigen::Vector2d& goal) {
  if (!isFree(start) || !isFree(goal)) return std::nullopt;
  costs_.assign(free_.size(), kInfinity);
  parents_.assign(free_.size(), -1);
  open_.clear();
  for (const int node : nodesNear(start)) reach(node, -1, (pointOf(node) - start).norm(), goal);
  std::vector<int> ends = nodesNear(goal);
  std::sort(ends.begin(), ends.end());
  double best = kInfinity;
  int last = -1;
  while (!open_.empty() && open_.front().estimate < best) {
    std::pop_heap(open_.begin(), open_.end(), Later());
    const Open from = open_.back();
    open_.pop_back();
    if (from.cost > costs_[static_cast<std::size_t>(from.node)]) continue;
    if (std::binary_search(ends.begin(), ends.end(), from.node)) {
      const double whole = from.cost + (pointOf(from.node) - goal).norm();
      if (whole < best) {
        best = whole;
        last = from.node;
      }
    }
    expand(from, goal);
  }
  if (last < 0) return std::nullopt;
  return trace(last, start, goal);
}

}  // namespace parley::sim

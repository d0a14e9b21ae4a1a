// SPDX-License-Identifier: BSD-3-Clause
#include "parley_sim/shortest_path.h"

#include <algorithm>
#include <cmath>

#include "lattice_search.h"

namespace parley::sim {
namespace {

using Path = std::vector<Eigen::Vector2d>;

constexpr double kShave = 0.002;  // [m] that a straight piece may come nearer to a corner than the radius
constexpr int kPulls = 6;

double lengthOf(const Path& path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length += (path[i] - path[i - 1]).norm();
  return length;
}

/// Whether the disc can go straight from a to b.
bool goesStraight(const World& world, const Eigen::Vector2d& a, const Eigen::Vector2d& b, double radius, double step) {
  const double length = (b - a).norm();
  if (length == 0.0) return true;
  const Eigen::Vector2d direction = (b - a) / length;
  for (double t = 0.0; t < length;) {
    const Eigen::Vector2d point = a + t * direction;
    double gap = world.freeRadius(point);
    if (gap <= radius + step) gap = world.distanceToSolid(point, radius + 4.0 * step);
    if (gap < radius - kShave) return false;
    t += std::max(gap - radius, 0.25 * step);
  }
  return true;
}

/// Pulls the string tight: from each point straight to the last one that can be seen from it.
Path pulled(const World& world, const Path& path, double radius, double step) {
  Path tight{path.front()};
  const auto visible = [&](std::size_t from, std::size_t to) { return goesStraight(world, path[from], path[to], radius, step); };
  for (std::size_t at = 0; at + 1 < path.size();) {
    std::size_t seen = at + 1, unseen = path.size();
    for (std::size_t leap = 2; at + leap < path.size(); leap *= 2) {  // gallop, then halve
      if (!visible(at, at + leap)) {
        unseen = at + leap;
        break;
      }
      seen = at + leap;
    }
    if (unseen == path.size() && visible(at, path.size() - 1)) seen = path.size() - 1;
    while (seen + 1 < unseen) {
      const std::size_t middle = (seen + unseen) / 2;
      (visible(at, middle) ? seen : unseen) = middle;
    }
    tight.push_back(path[seen]);
    at = seen;
  }
  return tight;
}

/// The same line with a point every `step` or less.
Path resampled(const Path& path, double step) {
  Path dense{path.front()};
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Eigen::Vector2d leg = path[i] - path[i - 1];
    const int pieces = std::max(1, static_cast<int>(std::ceil(leg.norm() / step)));
    for (int k = 1; k <= pieces; ++k) dense.push_back(path[i - 1] + static_cast<double>(k) / pieces * leg);
  }
  return dense;
}

}  // namespace

std::optional<Path> shortestPath(const World& world, const Eigen::Vector2d& start, const Eigen::Vector2d& goal, double radius) {
  LatticeSearch search(world, radius);
  const double step = search.spacing();
  if (!search.isFree(start) || !search.isFree(goal)) return std::nullopt;
  if (goesStraight(world, start, goal, radius, step)) return Path{start, goal};
  std::optional<Path> path = search.path(start, goal);
  // pulling from both ends in turn comes near the tightest string; one way alone overshoots each corner
  for (int pull = 0; path && pull < kPulls; ++pull) {
    Path tight = pulled(world, resampled(*path, step), radius, step);
    std::reverse(tight.begin(), tight.end());
    path = std::move(tight);
  }
  return path;
}

std::optional<double> shortestLength(const World& world, const Eigen::Vector2d& start, const Eigen::Vector2d& goal,
                                     double radius) {
  const std::optional<Path> path = shortestPath(world, start, goal, radius);
  if (!path) return std::nullopt;
  return lengthOf(*path);
}

}  // namespace parley::sim

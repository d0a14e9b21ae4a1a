// SPDX-License-Identifier: BSD-3-Clause
#include "local_goal.h"

#include <algorithm>
#include <cmath>

namespace parley {

namespace {

constexpr double kStep = 0.1;  // [m] along the route

struct Foot {
  std::size_t segment = 0;
  Eigen::Vector2d point = Eigen::Vector2d::Zero();  // [m]
};

Foot nearestOn(const std::vector<Eigen::Vector2d>& points, const Eigen::Vector2d& here) {
  Foot foot;
  double best = 1e30;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Eigen::Vector2d step = points[i + 1] - points[i];
    const double f = std::clamp((here - points[i]).dot(step) / std::max(1e-9, step.squaredNorm()), 0.0, 1.0);
    const Eigen::Vector2d candidate = points[i] + f * step;
    if ((candidate - here).squaredNorm() < best) {
      best = (candidate - here).squaredNorm();
      foot = {i, candidate};
    }
  }
  return foot;
}

}  // namespace

Eigen::Vector2d localGoal(const Route& route, const Eigen::Vector2d& here, double look_ahead, const GridFrame& window,
                          double rim) {
  const Eigen::Vector2d low = window.origin + Eigen::Vector2d::Constant(rim);
  const Eigen::Vector2d high = window.origin + window.size() - Eigen::Vector2d::Constant(rim);
  const Foot foot = nearestOn(route.points, here);
  Eigen::Vector2d goal = foot.point;
  double left = look_ahead;
  for (std::size_t i = foot.segment; i + 1 < route.points.size(); ++i) {
    const Eigen::Vector2d way = route.points[i + 1] - goal;
    const int pieces = std::max(1, static_cast<int>(std::ceil(way.norm() / kStep)));
    for (int k = 0; k < pieces; ++k) {
      const Eigen::Vector2d next = goal + way / pieces;
      left -= way.norm() / pieces;
      if (left < 0.0 || (next.array() < low.array()).any() || (next.array() > high.array()).any()) return goal;
      goal = next;
    }
  }
  return goal;
}

}  // namespace parley

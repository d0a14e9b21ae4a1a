// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "closed_loop.h"
#include "surroundings.h"

namespace parley {

/// A window of 10 x 10 m round the world's point (5, 5), all seen, walls as in the world.
inline LocalMap seenMap(const World& world) {
  LocalMap map;
  map.frame = {{0.0, 0.0}, 0.05, 200, 200};
  for (int y = 0; y < 200; ++y) {
    for (int x = 0; x < 200; ++x) {
      map.cells.push_back(world.solidAt(map.frame.centerOf({x, y})) ? CellState::kOccupied : CellState::kSeenFree);
    }
  }
  return map;
}

inline void setCells(LocalMap* map, double x1, double y1, double x2, double y2, CellState state) {
  for (int i = 0; i < static_cast<int>(map->cells.size()); ++i) {
    const Eigen::Vector2d p = map->frame.centerOf({i % map->frame.width, i / map->frame.width});
    if (p.x() > x1 && p.x() < x2 && p.y() > y1 && p.y() < y2) map->cells[static_cast<std::size_t>(i)] = state;
  }
}

/// What is wrong with a trajectory's motion by its numbers alone; empty if nothing. Knows nothing of the planner.
inline std::string motionFlaw(const std::vector<TrajectoryPoint>& points, const MotionLimits& limits) {
  const double slack = 1.001;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const TrajectoryPoint &a = points[i - 1], &b = points[i];
    const double dt = b.time - a.time;
    const std::string when = " at " + std::to_string(b.time);
    if (dt <= 0.0) return "time stands still" + when;
    if (std::abs(b.twist.speed) > limits.speed * slack) return "too fast" + when;
    if (std::abs(b.twist.turn_rate) > limits.turn_rate * slack) return "turns too fast" + when;
    if (std::abs(b.twist.speed - a.twist.speed) > limits.acceleration * dt * slack + 1e-9) return "acceleration" + when;
    if (std::abs(b.twist.turn_rate - a.twist.turn_rate) > limits.turn_acceleration * dt * slack + 1e-9) {
      return "turn acceleration" + when;
    }
    const Pose2 there =
        integrateTwist(a.pose, 0.5 * (a.twist.speed + b.twist.speed), 0.5 * (a.twist.turn_rate + b.twist.turn_rate), dt);
    if ((there.position() - b.pose.position()).norm() > 0.02) return "pose does not follow from twist" + when;
    if (std::abs(angleBetween(there.yaw, b.pose.yaw)) > 0.02) return "heading does not follow from twist" + when;
  }
  const Twist2 last = points.empty() ? Twist2{} : points.back().twist;
  if (last.speed != 0.0 || last.turn_rate != 0.0) return "does not end standing";
  return {};
}

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace parley {

/// What the topological map says about a goal.
enum class RouteVerdict {
  kNoGoal,             // nothing asked
  kThroughKnown,       // every step has been seen free
  kThroughUnknown,     // crosses space that this robot has not seen
  kUnreachableAsKnown  // all that is known closes it off
};

/// A way through the visibility graph, from the robot to its goal, in the odom frame.
struct Route {
  RouteVerdict verdict = RouteVerdict::kNoGoal;
  std::vector<Eigen::Vector2d> points;  // [m] start, corners, goal; empty if there is no way
  double length = 0.0;                  // [m]
  double cost = 0.0;                    // [m] length with what is unknown or narrow made dearer
  double narrowest = 0.0;               // [m] least clearance width of its edges
  int switches = 0;                     // [-] times the homotopy class changed since the goal was set

  bool exists() const { return points.size() >= 2; }
};

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "surroundings.h"

namespace parley {

using Path = std::vector<Eigen::Vector2d>;  // [m] odom frame

struct PathSearchOptions {
  double least_clearance = 0.22;  // [m] of the path's points: hard
  double comfort_distance = 0.5;  // [m] nearer costs more
  double clearance_weight = 3.0;  // [-]
  double unknown_cost = 1.5;      // [-]
  double keep_discount = 0.9;     // [-] cost factor along `previous`
};

/// A* over a lattice of two by two map cells with clearance cost.
/// Returns the chain of lattice points from the start to the goal, both included as given. Where the goal is closed off: to
/// the furthest point of `route` (evenly spaced, to the goal) that can be reached, if that is at least `kLeastAdvance` on and
/// no point near the goal can; else to the reachable point nearest to the goal, if that is so much nearer than the start.
struct FoundPath {
  Path points;           // empty if there is none
  bool reaches = false;  // the goal itself
};
constexpr double kLeastAdvance = 0.3;  // [m]

FoundPath searchPath(const Surroundings& surroundings, const Eigen::Vector2d& start, const Eigen::Vector2d& goal,
                     const Path& previous, const PathSearchOptions& options, const Path& route = {});

/// The same way with fewer corners: shortcuts that come no nearer to obstacles than what they replace, or than comfort.
Path straightened(const Surroundings& surroundings, const Path& path, double comfort_distance);

/// The path without its last `by` [m]; empty if nothing is left.
Path shortened(const Path& path, double by);

/// Points every `spacing` along the path, ends kept; spacing is shrunk to fit.
Path resampled(const Path& path, double spacing);

}  // namespace parley

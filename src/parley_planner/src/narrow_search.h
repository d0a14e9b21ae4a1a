// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "drive_generator.h"

namespace parley {

struct NarrowSearchOptions {
  int expansions = 4000;                    // [-] bound of the search
  double clearance = 0.02;                  // [m] of the footprint
  double slow_speed = 0.5;                  // [m/s] highest on the way
  std::vector<Blocked::Body> bodies = {};   // that stand, not nearer to which than their growth, or than at the start
  const Surroundings* with_them = nullptr;  // null: there are none
};

/// A* over positions and headings with the exact footprint, for places where the rectangle has to turn before it fits:
/// turns on the spot, straight and curved moves forwards and backwards. Returns them as one trajectory from standing to
/// standing, each move time-optimal within the limits; empty if the bound was reached or there is no way.
/// The target is a disc of `kTargetRadius` round a place, with any heading.
std::vector<TrajectoryPoint> searchNarrow(const TrajectoryPoint& start, const Eigen::Vector2d& target,
                                          const Surroundings& surroundings, const FootprintProbe& probe,
                                          const MotionLimits& limits, double time_step, const NarrowSearchOptions& options);
constexpr double kTargetRadius = 0.25;  // [m]

/// A piece of a circle (or line) driven from standing to standing; `length` [m] is negative backwards.
std::vector<TrajectoryPoint> driveArc(const TrajectoryPoint& start, double curvature, double length, double speed,
                                      const MotionLimits& limits, double time_step);

}  // namespace parley

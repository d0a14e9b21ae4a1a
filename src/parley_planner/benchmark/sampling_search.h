// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "narrow_problems.h"
#include "parley_geometry/trajectory.h"

namespace parley::study {

struct SamplingOptions {
  bool optimal = false;     // RRT* for all of the time instead of RRTConnect
  double time_limit = 0.2;  // [s] of the thread's CPU
  double range = 1.0;       // [s] of one motion of the tree
  double clearance = 0.05;  // [m] of the footprint
  double room = 2.0;        // [m] that samples are drawn in, round the box of start and target
  unsigned seed = 1;
};

/// OMPL's answer to a problem: RRTConnect or RRT* over `TurnDriveSpace`, then OMPL's short cuts, with the lattice search's
/// question of what is free. Turns on the spot and straights from standing to standing, each time-optimal; empty if none was
/// found.
std::vector<TrajectoryPoint> searchBySampling(const NarrowProblem& problem, const FootprintProbe& probe,
                                              const MotionLimits& limits, double time_step, const SamplingOptions& options);

/// CPU time of this thread. [s]
double threadSeconds();

}  // namespace parley::study

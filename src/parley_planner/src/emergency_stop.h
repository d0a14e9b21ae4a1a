// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "parley_geometry/trajectory.h"
#include "trajectory_validator.h"

namespace parley {

/// Braking as hard as the limits allow from a state on, on the path of a trajectory for as long as that is driven the same
/// way round, then on the last curvature. Ends with zero twist. `path` must not be empty.
SampledTrajectory brakingAlong(const SampledTrajectory& path, const TrajectoryPoint& from, const MotionLimits& limits,
                               double time_step);

/// The best of braking on the committed path, on the present curvature and while straightening: one that touches nothing,
/// else the one that is slowest where it touches what stands, then what moves. What is committed was planned round the
/// obstacles, but may be what has just been found to be shut.
SampledTrajectory safestStop(const TrajectoryValidator& validator, const SampledTrajectory& committed,
                             const TrajectoryPoint& from, const MotionLimits& limits, double time_step);

}  // namespace parley

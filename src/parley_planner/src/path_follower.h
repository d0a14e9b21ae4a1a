// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "parley_geometry/trajectory.h"
#include "speed_profile.h"

namespace parley {

/// A simulated drive along a path: what the robot would really do, within its limits by construction.
struct PathDrive {
  std::vector<TrajectoryPoint> points;  // ends standing
  std::vector<double> arc_lengths;      // [m] on the path, of each point
};

/// Simulates a tracking law with the drive's exact limits from a state. `limits`: what the tracking may use, turns and
/// speed changes included. `reverse`: the path is driven backwards. Bounded by `kLongestDrive` seconds.
PathDrive followPath(const ReferencePath& path, const SpeedProfile& profile, const TrajectoryPoint& start, bool reverse,
                     const MotionLimits& limits, double time_step);
constexpr double kLongestDrive = 30.0;  // [s]

/// Turning on the spot from standing, fastest within the limits. Ends standing at `yaw` [rad].
std::vector<TrajectoryPoint> turnOnSpot(const TrajectoryPoint& start, double yaw, const MotionLimits& limits, double time_step);

}  // namespace parley

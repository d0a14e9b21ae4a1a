// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "parley_geometry/motion.h"

namespace parley {

struct TrajectoryPoint {
  double time = 0.0;  // [s] of the robot's clock
  Pose2 pose;         // T_odom_base
  Twist2 twist;
};

/// A robot's motion as states in time, evenly spaced or not; before the first it is there, after the last it stays there.
class SampledTrajectory {
 public:
  SampledTrajectory() = default;
  /// Times must not decrease; asserted.
  explicit SampledTrajectory(std::vector<TrajectoryPoint> points);

  bool empty() const { return points_.empty(); }
  double startTime() const { return points_.front().time; }
  double endTime() const { return points_.back().time; }
  double duration() const { return empty() ? 0.0 : endTime() - startTime(); }
  const std::vector<TrajectoryPoint>& points() const { return points_; }

  /// State at a time, interpolated; outside the trajectory the nearest end, standing. Must not be empty.
  TrajectoryPoint at(double time) const;

  /// Path length of all of it, reversing counted positive. [m]
  double length() const;

  /// The part from `time` on, with its first state interpolated there.
  SampledTrajectory from(double time) const;

  /// Standing at a pose at a time.
  static SampledTrajectory standing(const Pose2& pose, double time);

 private:
  std::vector<TrajectoryPoint> points_;
};

/// Curvature to drive while braking [1/m], from the twist before a time step and the speed after it [m/s].
using CurvatureLaw = std::function<double(const Twist2& before, double speed_after)>;

/// Braking from a state at constant deceleration until it stands, with the turn rate following `curvature` as fast as the
/// turn acceleration allows. Ends with zero twist.
SampledTrajectory brakingTrajectory(const TrajectoryPoint& from, const MotionLimits& limits, double time_step,
                                    const CurvatureLaw& curvature);

/// Braking from a state on a constant curvature at constant deceleration until it stands. Ends with zero twist.
SampledTrajectory brakingTrajectory(const TrajectoryPoint& from, const MotionLimits& limits, double time_step);

}  // namespace parley

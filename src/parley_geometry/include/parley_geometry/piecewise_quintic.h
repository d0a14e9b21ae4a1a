// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "parley_geometry/polynomial.h"
#include "parley_geometry/trajectory.h"

namespace parley {

/// The curve p(t) of equation 1 of the paper: quintic pieces of equal duration between knots, the flat output of a differential
/// drive. Position, velocity and acceleration are continuous by construction. In the frame of its knots.
class PiecewiseQuintic {
 public:
  PiecewiseQuintic() = default;
  /// At least two knots, evenly spaced over `duration` > 0 [s]; asserted.
  PiecewiseQuintic(const std::vector<FlatState>& knots, double duration);

  bool empty() const { return pieces_.empty(); }
  std::size_t pieceCount() const { return pieces_.size(); }
  double duration() const { return duration_; }  // [s]
  /// State at `t` [s] since the beginning, clamped to the ends. Must not be empty.
  FlatState at(double t) const;
  /// Third derivative at `t` [s]; at a knot that of the piece after it. [m/s^3]
  Eigen::Vector2d jerk(double t) const;
  /// Integral of squared jerk, exact: the first term of equation 1. [m^2/s^5]
  double jerkCost() const;
  /// States every `time_step` [s], the end included, from `start_time` [s] on, driven forwards, or backwards as a whole; heading
  /// from the velocity, held where the speed is below 1 mm/s: the first such heading is `initial_yaw` [rad].
  SampledTrajectory sampled(double start_time, double time_step, double initial_yaw, bool reverse = false) const;

 private:
  struct Place {
    std::size_t piece;
    double t;  // [s] since the piece began
  };
  Place placeOf(double t) const;

  std::vector<QuinticPiece> pieces_;
  double duration_ = 0.0;  // [s]
};

}  // namespace parley

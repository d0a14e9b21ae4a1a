// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "parley_geometry/trajectory.h"

namespace parley {

/// Position and its derivatives: columns are the flat output p and its derivatives up to order two, in the odom frame.
struct FlatState {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();      // [m]
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();      // [m/s]
  Eigen::Vector2d acceleration = Eigen::Vector2d::Zero();  // [m/s^2]
};

/// p(t) of degree five on [0, duration].
class QuinticPiece {
 public:
  /// The one quintic that joins two states in `duration` > 0 seconds.
  static QuinticPiece between(const FlatState& start, const FlatState& end, double duration);

  double duration() const { return duration_; }
  FlatState at(double t) const;
  Eigen::Vector2d jerk(double t) const;
  /// Integral of squared jerk over the piece, exact. [m^2/s^5]
  double jerkCost() const;

 private:
  Eigen::Matrix<double, 2, 6> coefficients_ = Eigen::Matrix<double, 2, 6>::Zero();
  double duration_ = 0.0;
};

/// Quintic pieces end to end, driven forwards or backwards as a whole.
struct PolynomialTrajectory {
  double start_time = 0.0;  // [s]
  bool reverse = false;
  std::vector<QuinticPiece> pieces;

  double duration() const;
  /// Clamped to the ends.
  FlatState at(double time) const;
  /// States every `time_step`, the end included; heading from the velocity, held where the speed is below 1 mm/s.
  SampledTrajectory sampled(double time_step, double initial_yaw) const;
};

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

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

}  // namespace parley

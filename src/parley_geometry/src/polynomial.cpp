// SPDX-License-Identifier: BSD-3-Clause
#include "parley_geometry/polynomial.h"

#include <cassert>

namespace parley {

QuinticPiece QuinticPiece::between(const FlatState& start, const FlatState& end, double duration) {
  assert(duration > 0.0);
  const double t1 = duration, t2 = t1 * t1, t3 = t2 * t1, t4 = t3 * t1, t5 = t4 * t1;
  const Eigen::Vector2d dp = end.position - start.position - start.velocity * t1 - 0.5 * start.acceleration * t2;
  const Eigen::Vector2d dv = end.velocity - start.velocity - start.acceleration * t1;
  const Eigen::Vector2d da = end.acceleration - start.acceleration;
  QuinticPiece piece;
  piece.duration_ = duration;
  piece.coefficients_.col(0) = start.position;
  piece.coefficients_.col(1) = start.velocity;
  piece.coefficients_.col(2) = 0.5 * start.acceleration;
  piece.coefficients_.col(3) = 10.0 * dp / t3 - 4.0 * dv / t2 + 0.5 * da / t1;
  piece.coefficients_.col(4) = -15.0 * dp / t4 + 7.0 * dv / t3 - da / t2;
  piece.coefficients_.col(5) = 6.0 * dp / t5 - 3.0 * dv / t4 + 0.5 * da / t3;
  return piece;
}

FlatState QuinticPiece::at(double t) const {
  const auto& c = coefficients_;
  FlatState state;
  state.position = c.col(0) + t * (c.col(1) + t * (c.col(2) + t * (c.col(3) + t * (c.col(4) + t * c.col(5)))));
  state.velocity = c.col(1) + t * (2.0 * c.col(2) + t * (3.0 * c.col(3) + t * (4.0 * c.col(4) + t * 5.0 * c.col(5))));
  state.acceleration = 2.0 * c.col(2) + t * (6.0 * c.col(3) + t * (12.0 * c.col(4) + t * 20.0 * c.col(5)));
  return state;
}

Eigen::Vector2d QuinticPiece::jerk(double t) const {
  return 6.0 * coefficients_.col(3) + t * (24.0 * coefficients_.col(4) + t * 60.0 * coefficients_.col(5));
}

double QuinticPiece::jerkCost() const {
  const Eigen::Vector2d a = 6.0 * coefficients_.col(3), b = 24.0 * coefficients_.col(4), c = 60.0 * coefficients_.col(5);
  const double t = duration_;
  return t * (a.dot(a) + t * (a.dot(b) + t * ((b.dot(b) + 2.0 * a.dot(c)) / 3.0 + t * (0.5 * b.dot(c) + t * c.dot(c) / 5.0))));
}

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "parley_geometry/piecewise_quintic.h"

namespace parley {

/// A knot in the variables that are optimised: position, velocity times and acceleration times the square of a piece's duration,
/// (px, py, ux, uy, wx, wy). [m] In these the shape of a piece does not depend on its duration.
using KnotBlock = std::array<double, 6>;

/// A piecewise quintic as what is optimised. The duration's logarithm keeps it positive.
struct CurveVariables {
  FlatState start;               // fixed: its scaled knot depends on the duration alone
  std::vector<KnotBlock> knots;  // all after the start; of the last nothing is free
  double log_duration = 0.0;     // [-] of a piece, in seconds

  /// `knots`: at least two, over `duration` > 0 [s].
  static CurveVariables of(const std::vector<FlatState>& knots, double duration);
  PiecewiseQuintic curve() const;
};

KnotBlock scaledKnot(const FlatState& knot, double piece_duration);

/// Row k: derivative of order k with respect to tau in [0, 1] of one coordinate of a piece, as weights of that coordinate's six
/// scaled values: p, u, w at its beginning, then at its end.
using DerivativeRows = Eigen::Matrix<double, 4, 6>;
DerivativeRows derivativesAt(double tau);

/// The linear map from the six scaled values of one coordinate to residuals whose squares sum up to the integral of the squared
/// third derivative over tau. The 6 x 6 Gram matrix of that integral has rank three: three rows are its exact root.
using JerkRoot = Eigen::Matrix<double, 3, 6>;
JerkRoot jerkRoot();

}  // namespace parley

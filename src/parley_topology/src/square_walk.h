// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>

#include "tiled_map.h"

namespace parley {

/// The squares of a grid that a straight way passes, one after another. Lengths are in sides of a square.
class SquareWalk {
 public:
  /// Begins at the fraction `enter` of the way, in a square of `bounds`.
  SquareWalk(const Eigen::Vector2d& from, const Eigen::Vector2d& way, double enter, const CellRect& bounds) {
    const int low[2] = {bounds.x0, bounds.y0}, high[2] = {bounds.x1 - 1, bounds.y1 - 1};
    for (int k = 0; k < 2; ++k) {
      square_[k] = std::clamp(static_cast<int>(std::floor(from[k] + enter * way[k])), low[k], high[k]);
      sign_[k] = way[k] > 0.0 ? 1 : -1;
      const bool still = std::abs(way[k]) < 1e-12;
      step_[k] = still ? std::numeric_limits<double>::infinity() : 1.0 / std::abs(way[k]);
      next_[k] = still ? step_[k] : (square_[k] + (sign_[k] > 0 ? 1 : 0) - from[k]) / way[k];
    }
  }

  int x() const { return square_[0]; }
  int y() const { return square_[1]; }

  /// The fraction of the way at which it leaves the square.
  double leavesAt() const { return std::min(next_[0], next_[1]); }

  /// Goes to the next square; false if the way has ended at the fraction `leave` before.
  bool advance(double leave) {
    const int k = next_[0] < next_[1] ? 0 : 1;
    if (next_[k] > leave) return false;
    square_[k] += sign_[k];
    next_[k] += step_[k];
    return true;
  }

 private:
  int square_[2], sign_[2];
  double next_[2], step_[2];  // fractions at which the next line between squares is crossed, and between such lines
};

}  // namespace parley

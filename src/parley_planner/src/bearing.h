// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "parley_geometry/angles.h"

namespace parley {

/// atan2(y, x) to 2e-8 rad, in about half the time (Abramowitz and Stegun, 4.4.49).
inline double bearingOf(double x, double y) {
  const double ax = std::abs(x), ay = std::abs(y);
  const double most = std::max(ax, ay);
  if (!(most > 0.0)) return 0.0;
  const double z = std::min(ax, ay) / most, q = z * z;
  const double series =
      1.0 +
      q * (-0.3333314528 +
           q * (0.1999355085 +
                q * (-0.1420889944 +
                     q * (0.1065626393 + q * (-0.0752896400 + q * (0.0429096138 + q * (-0.0161657367 + q * 0.0028662257)))))));
  const double angle = ax >= ay ? z * series : 0.5 * kPi - z * series;
  return std::copysign(x >= 0.0 ? angle : kPi - angle, y);
}

}  // namespace parley

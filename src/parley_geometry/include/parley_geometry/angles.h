// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

namespace parley {

constexpr double kPi = 3.14159265358979323846;

/// The same angle in [-pi, pi). [rad]
inline double wrapAngle(double angle) {
  if (angle >= -kPi && angle < kPi) return angle;
  const double wrapped = angle - 2.0 * kPi * std::floor((angle + kPi) / (2.0 * kPi));
  return wrapped < kPi ? wrapped : -kPi;  // rounding can land on pi itself
}

/// The turn from `from` to `to` by the shorter way, in [-pi, pi). [rad]
inline double angleBetween(double from, double to) { return wrapAngle(to - from); }

inline double degrees(double radians) { return radians * 180.0 / kPi; }
inline double radians(double degrees) { return degrees * kPi / 180.0; }

}  // namespace parley

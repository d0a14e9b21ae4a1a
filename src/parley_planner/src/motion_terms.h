// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "flat_sample.h"
#include "parley_geometry/motion.h"

namespace parley {

/// Speed above a bound [m/s].
template <class T>
T speedExcess(const FlatSample<T>& x, const T& bound) {
  using std::sqrt;
  return excess<T>(sqrt(smoothSquare(x)) - bound);
}

/// Turn rate of a differential drive on the curve. [rad/s]
template <class T>
T turnRateOf(const FlatSample<T>& x) {
  return (x.velocity.x() * x.acceleration.y() - x.velocity.y() * x.acceleration.x()) / smoothSquare(x);
}

/// Turn rate above a bound [rad/s].
template <class T>
T turnRateExcess(const FlatSample<T>& x, double bound) {
  using std::abs;
  return excess<T>(abs(turnRateOf(x)) - T(bound));
}

/// Acceleration along the curve above a bound [m/s^2].
template <class T>
T accelerationExcess(const FlatSample<T>& x, double bound) {
  using std::abs;
  return excess<T>(abs(directionOf(x).dot(x.acceleration)) - T(bound));
}

/// Change of the turn rate above a bound [rad/s^2].
template <class T>
T turnAccelerationExcess(const FlatSample<T>& x, double bound) {
  using std::abs;
  const T square = smoothSquare(x);
  const T twist = (x.velocity.x() * x.jerk.y() - x.velocity.y() * x.jerk.x()) / square;
  const T change = twist - T(2.0) * turnRateOf(x) * x.velocity.dot(x.acceleration) / square;
  return excess<T>(abs(change) - T(bound));
}

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <type_traits>

namespace parley {

/// The flat output and its derivatives at one moment, for cost terms that are differentiated automatically: T is double or a
/// dual number.
template <class T>
struct FlatSample {
  using Vector = Eigen::Matrix<T, 2, 1>;
  Vector position;      // [m]
  Vector velocity;      // [m/s]
  Vector acceleration;  // [m/s^2]
  Vector jerk;          // [m/s^3]
};

/// Below about this the direction of the velocity says nothing, and what depends on it fades out. [m/s]
constexpr double kSmoothSpeed = 0.05;

/// Square of the speed, kept away from zero.
template <class T>
T smoothSquare(const FlatSample<T>& x) {
  return x.velocity.squaredNorm() + T(kSmoothSpeed * kSmoothSpeed);
}

/// Direction of the motion; shorter than one where it almost stands.
template <class T>
Eigen::Matrix<T, 2, 1> directionOf(const FlatSample<T>& x) {
  using std::sqrt;
  const T speed = sqrt(smoothSquare(x));
  return {x.velocity.x() / speed, x.velocity.y() / speed};
}

/// Heading of the robot on the curve; that of `fallback`, a unit vector, where it almost stands.
template <class T>
Eigen::Matrix<T, 2, 1> headingOf(const FlatSample<T>& x, const Eigen::Vector2d& fallback) {
  using std::sqrt;
  const Eigen::Matrix<T, 2, 1> ahead(x.velocity.x() + T(kSmoothSpeed * fallback.x()),
                                     x.velocity.y() + T(kSmoothSpeed * fallback.y()));
  const T length = sqrt(ahead.squaredNorm() + T(1e-8));
  return {ahead.x() / length, ahead.y() / length};
}

/// A point of the robot, given in base_link, when it is at `position` with a heading.
template <class T>
Eigen::Matrix<T, 2, 1> carried(const Eigen::Vector2d& p_base, const Eigen::Matrix<T, 2, 1>& position,
                               const Eigen::Matrix<T, 2, 1>& heading) {
  return {position.x() + T(p_base.x()) * heading.x() - T(p_base.y()) * heading.y(),
          position.y() + T(p_base.x()) * heading.y() + T(p_base.y()) * heading.x()};
}

/// The number without its derivatives.
template <class T>
double realPart(const T& value) {
  if constexpr (std::is_same_v<T, double>) {
    return value;
  } else {
    return value.a;
  }
}

/// By how much something exceeds its bound, else 0; its square has a continuous derivative.
template <class T>
T excess(const T& value) {
  return value > T(0.0) ? value : T(0.0);
}

}  // namespace parley

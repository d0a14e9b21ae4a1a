// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "distance_field.h"
#include "flat_sample.h"
#include "margins.h"

namespace parley {

/// Distance of a point from what a field marks. [m]
template <class T>
T distanceAt(const DistanceField& field, const Eigen::Matrix<T, 2, 1>& p) {
  const Eigen::Vector2d here(realPart(p.x()), realPart(p.y()));
  const DistanceField::Sample sample = field.sample(here);
  return T(sample.distance) + T(sample.gradient.x()) * (p.x() - T(here.x())) + T(sample.gradient.y()) * (p.y() - T(here.y()));
}

/// What a disc of the footprint, with its middle there, lacks of its margin, which grows with the speed. [m]
template <class T>
T marginLack(const FlatSample<T>& x, const DistanceField& obstacles, const Eigen::Matrix<T, 2, 1>& middle, double radius,
             const Margins& margins) {
  using std::sqrt;
  const T faster = excess<T>(sqrt(smoothSquare(x)) - T(margins.creep_speed));
  return excess<T>(T(margins.creeping + radius) + T(margins.per_speed) * faster - distanceAt(obstacles, middle));
}

/// What the middle of the robot lacks of a distance [m] to what pushes paths away.
template <class T>
T pushLack(const FlatSample<T>& x, const DistanceField& shape, const T& distance) {
  return excess<T>(distance - distanceAt(shape, x.position));
}

}  // namespace parley

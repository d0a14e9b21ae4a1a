// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <vector>

#include "flat_sample.h"
#include "reference_path.h"

namespace parley {

/// Where a point is beside a path.
template <class T>
struct PathOffset {
  T along;    // [m] arc length of the nearest point
  T lateral;  // [m] to the left of the path
};

/// The nearest point within `reach` [m] along the path of the arc length `near_s` [m]. The path is a chain of straight
/// lines; the derivatives are those beside the line that the nearest point is on, also where that is its end.
template <class T>
PathOffset<T> offsetFrom(const ReferencePath& path, const Eigen::Matrix<T, 2, 1>& p, double near_s, double reach) {
  const Eigen::Vector2d here(realPart(p.x()), realPart(p.y()));
  const double s = path.project(here, near_s, reach);
  const std::vector<double>& lengths = path.arcLengths();
  const auto after = std::upper_bound(lengths.begin() + 1, lengths.end() - 1, s);
  const auto i = static_cast<std::size_t>(after - lengths.begin());
  const Eigen::Vector2d from = path.points()[i - 1];
  const Eigen::Vector2d direction = (path.points()[i] - from) / (lengths[i] - lengths[i - 1]);
  const T x = p.x() - T(from.x()), y = p.y() - T(from.y());
  const T moved = (p.x() - T(here.x())) * T(direction.x()) + (p.y() - T(here.y())) * T(direction.y());
  return {T(s) + moved, y * T(direction.x()) - x * T(direction.y())};
}

/// A value given at each of a path's points, at an arc length [m]; that of the nearest end beyond them.
template <class T>
T valueAlong(const ReferencePath& path, const std::vector<double>& values, const T& s) {
  const std::vector<double>& lengths = path.arcLengths();
  const double where = realPart(s);
  if (where <= lengths.front()) return T(values.front());
  if (where >= lengths.back()) return T(values.back());
  const auto i = static_cast<std::size_t>(std::upper_bound(lengths.begin(), lengths.end(), where) - lengths.begin());
  const double slope = (values[i] - values[i - 1]) / (lengths[i] - lengths[i - 1]);
  return T(values[i - 1]) + T(slope) * (s - T(lengths[i - 1]));
}

}  // namespace parley

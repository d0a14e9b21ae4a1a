// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <vector>

#include "parley_geometry/polygon.h"

namespace parley {

/// The greatest of some numbers, each times `sign`, and the sum of exponentials of what the others lack of it.
template <class T>
struct SmoothPeak {
  T greatest;
  T sum = T(0.0);

  SmoothPeak(const std::vector<T>& values, double sign, double sharpness) : greatest(T(sign) * values.front()) {
    using std::exp;
    for (const T& value : values) {
      if (T(sign) * value > greatest) greatest = T(sign) * value;
    }
    for (const T& value : values) sum += exp((T(sign) * value - greatest) * T(sharpness));
  }
};

/// The greatest of some numbers, smoothly, and never more than that: less by at most log(count) / sharpness.
template <class T>
T smoothGreatest(const std::vector<T>& values, double sharpness) {
  using std::log;
  const SmoothPeak<T> peak(values, 1.0, sharpness);
  return peak.greatest + log(peak.sum / T(static_cast<double>(values.size()))) / T(sharpness);
}

/// The least of some numbers, smoothly, and never more than that: less by at most log(count) / sharpness.
template <class T>
T smoothLeast(const std::vector<T>& values, double sharpness) {
  using std::log;
  const SmoothPeak<T> peak(values, -1.0, sharpness);
  return -peak.greatest - log(peak.sum) / T(sharpness);
}

/// Signed distance of two convex, counter-clockwise polygons that has derivatives everywhere: the widest gap along any edge's
/// normal (separating axes), with smooth least and greatest values. Negative where they overlap (how far one would have to be
/// pushed out), not more than the true distance, and less by more than the smoothing only where corner faces corner.
/// `sharpness`: [1/m] of the smoothing.
template <class T>
T smoothPolygonDistance(const std::vector<Eigen::Matrix<T, 2, 1>>& a, const Polygon& b, double sharpness) {
  using std::sqrt;
  std::vector<T> gaps;
  std::vector<T> heights(a.size());  // of one polygon's corners over an edge of the other
  for (std::size_t i = 0; i < b.size(); ++i) {
    const Eigen::Vector2d edge = b[(i + 1) % b.size()] - b[i];
    const Eigen::Vector2d normal = Eigen::Vector2d(edge.y(), -edge.x()) / edge.norm();
    for (std::size_t j = 0; j < a.size(); ++j) {
      heights[j] = T(normal.x()) * (a[j].x() - T(b[i].x())) + T(normal.y()) * (a[j].y() - T(b[i].y()));
    }
    gaps.push_back(smoothLeast(heights, sharpness));
  }
  heights.resize(b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Eigen::Matrix<T, 2, 1> edge = a[(i + 1) % a.size()] - a[i];
    const T length = sqrt(edge.squaredNorm() + T(1e-12));
    for (std::size_t j = 0; j < b.size(); ++j) {
      heights[j] = (edge.y() * (T(b[j].x()) - a[i].x()) - edge.x() * (T(b[j].y()) - a[i].y())) / length;
    }
    gaps.push_back(smoothLeast(heights, sharpness));
  }
  return smoothGreatest(gaps, sharpness);
}

}  // namespace parley

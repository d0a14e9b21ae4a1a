// SPDX-License-Identifier: BSD-3-Clause
#include "body_view.h"

#include <algorithm>
#include <cmath>

namespace parley {
namespace {

constexpr int kRays = 11;          // [-] across what is seen
constexpr double kNearest = 0.15;  // [m] from the outline

/// Range along a ray to the nearest side of a rectangle about the origin, +inf beside it.
double rangeToBox(const Eigen::Vector2d& from, const Eigen::Vector2d& direction, const Eigen::Vector2d& half) {
  double enter = 0.0, leave = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 2; ++axis) {
    if (std::abs(direction[axis]) < 1e-12) {
      if (std::abs(from[axis]) > half[axis]) return std::numeric_limits<double>::infinity();
      continue;
    }
    const double a = (-half[axis] - from[axis]) / direction[axis], b = (half[axis] - from[axis]) / direction[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave ? enter : std::numeric_limits<double>::infinity();
}

}  // namespace

std::optional<SightedBlob> viewOfBody(const Footprint& footprint, const Pose2& T_scan_body) {
  const Pose2 T_body_scan = T_scan_body.inverse();
  const Eigen::Vector2d half(0.5 * footprint.length, 0.5 * footprint.width);
  const Eigen::Vector2d outside = (T_body_scan.position().cwiseAbs() - half).cwiseMax(0.0);
  if (outside.norm() < kNearest) return std::nullopt;
  const double middle = std::atan2(T_scan_body.y, T_scan_body.x);
  double least = 0.0, most = 0.0;  // [rad] from the bearing of the body's middle
  for (const Eigen::Vector2d& corner : footprint.polygonAt(T_scan_body)) {
    const double bearing = angleBetween(middle, std::atan2(corner.y(), corner.x()));
    least = std::min(least, bearing);
    most = std::max(most, bearing);
  }
  const double ahead_bearing = middle + 0.5 * (least + most);
  const Eigen::Vector2d ahead(std::cos(ahead_bearing), std::sin(ahead_bearing)), aside(-ahead.y(), ahead.x());
  double depth = 0.0, low = 0.0, high = 0.0;  // [m]
  int hits = 0;
  for (int i = 0; i < kRays; ++i) {
    const double bearing = middle + least + (most - least) * (i + 0.5) / kRays;
    const Eigen::Vector2d ray(std::cos(bearing), std::sin(bearing));
    const Eigen::Vector2d ray_body = T_body_scan * ray - T_body_scan.position();
    const double range = rangeToBox(T_body_scan.position(), ray_body, half);
    if (!std::isfinite(range)) continue;
    depth += range * ray.dot(ahead);
    low = std::min(low, range * ray.dot(aside));
    high = std::max(high, range * ray.dot(aside));
    ++hits;
  }
  if (hits == 0) return std::nullopt;
  // The outermost rays stand half a ray's width inside the outline.
  const double chord = (high - low) * kRays / (kRays - 1.0);
  return SightedBlob{depth / hits * ahead + 0.5 * (low + high) * aside, chord};
}

}  // namespace parley

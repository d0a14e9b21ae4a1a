// SPDX-License-Identifier: BSD-3-Clause
#include "body_view.h"

#include <Eigen/Geometry>
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
  // Much of a meeting's time goes into this, so rotations are worked out once each.
  const Eigen::Matrix2d rotation = Eigen::Rotation2Dd(T_scan_body.yaw).toRotationMatrix();
  const Eigen::Vector2d origin = T_scan_body.position();
  const Eigen::Vector2d from = -(rotation.transpose() * origin);
  const Eigen::Vector2d half(0.5 * footprint.length, 0.5 * footprint.width);
  const Eigen::Vector2d outside = (from.cwiseAbs() - half).cwiseMax(0.0);
  if (outside.norm() < kNearest) return std::nullopt;
  const Eigen::Vector2d middle = origin.normalized();
  double least = 0.0, most = 0.0;  // [rad] from the bearing of the body's middle
  for (const double x : {-half.x(), half.x()}) {
    for (const double y : {-half.y(), half.y()}) {
      const Eigen::Vector2d corner = origin + rotation * Eigen::Vector2d(x, y);
      const double bearing = std::atan2(middle.x() * corner.y() - middle.y() * corner.x(), middle.dot(corner));
      least = std::min(least, bearing);
      most = std::max(most, bearing);
    }
  }
  const auto turned = [&middle](double angle) -> Eigen::Vector2d { return Eigen::Rotation2Dd(angle) * middle; };
  const Eigen::Vector2d ahead = turned(0.5 * (least + most)), aside(-ahead.y(), ahead.x());
  const Eigen::Matrix2d step = Eigen::Rotation2Dd((most - least) / kRays).toRotationMatrix();
  Eigen::Vector2d ray = turned(least + 0.5 * (most - least) / kRays);
  double depth = 0.0, low = 0.0, high = 0.0;  // [m]
  int hits = 0;
  for (int i = 0; i < kRays; ++i, ray = step * ray) {
    const double range = rangeToBox(from, rotation.transpose() * ray, half);
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

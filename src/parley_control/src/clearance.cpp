// SPDX-License-Identifier: BSD-3-Clause
#include "clearance.h"

#include <algorithm>
#include <cmath>

namespace parley {
namespace {

constexpr double kContact = 0.01;    // [m] no way leads nearer than this to anything that is further off
constexpr double kTolerance = 1e-3;  // [m] of "nearer still"

struct Box {
  double min_x = 0.0, max_x = 0.0, min_y = 0.0, max_y = 0.0;  // [m]

  bool contains(const Eigen::Vector2d& p) const { return p.x() >= min_x && p.x() <= max_x && p.y() >= min_y && p.y() <= max_y; }
  double reach() const { return std::hypot(std::max(-min_x, max_x), std::max(-min_y, max_y)); }
};

/// What the sweep covers, `margin` around it.
Box boundsOf(const std::vector<Pose2>& sweep, const Footprint& footprint, double margin) {
  Box box;
  for (const Pose2& pose : sweep) {
    const double c = std::abs(std::cos(pose.yaw)), s = std::abs(std::sin(pose.yaw));
    const double x = 0.5 * (c * footprint.length + s * footprint.width) + margin;
    const double y = 0.5 * (s * footprint.length + c * footprint.width) + margin;
    box = {std::min(box.min_x, pose.x - x), std::max(box.max_x, pose.x + x), std::min(box.min_y, pose.y - y),
           std::max(box.max_y, pose.y + y)};
  }
  return box;
}

/// The scan's returns within a box of the present base frame.
std::vector<Eigen::Vector2d> returnsIn(const Box& box, const ObstacleScan& scan, const Pose2& T_base_scan) {
  const Eigen::Vector2d lidar = T_base_scan * scan.origin;
  const double furthest = box.reach() + lidar.norm();
  const double step = 2.0 * kPi / static_cast<double>(scan.binCount());
  const double c = std::cos(step), s = std::sin(step);
  const double first = T_base_scan.yaw + scan.bearingOf(0);
  Eigen::Vector2d ray(std::cos(first), std::sin(first));
  std::vector<Eigen::Vector2d> returns;
  for (const float range : scan.ranges) {
    if (range > 0.0F && range <= furthest) {
      const Eigen::Vector2d p = lidar + static_cast<double>(range) * ray;
      if (box.contains(p)) returns.push_back(p);
    }
    ray = {c * ray.x() - s * ray.y(), s * ray.x() + c * ray.y()};  // turning it on is cheaper than a sine for each
  }
  return returns;
}

/// Distance of a point in the base frame from the footprint, negative inside. [m]
double distanceFrom(const Footprint& footprint, double x, double y) {
  const double dx = std::abs(x) - 0.5 * footprint.length, dy = std::abs(y) - 0.5 * footprint.width;
  return dx <= 0.0 || dy <= 0.0 ? std::max(dx, dy) : std::hypot(dx, dy);
}

struct Return {
  Eigen::Vector2d p_base;  // [m]
  double distance;         // [m] from the footprint now
};

/// Deep inside the footprint there can be no obstacle: such a return is of the robot itself.
std::vector<Return> withDistances(const std::vector<Eigen::Vector2d>& returns, const Footprint& footprint) {
  std::vector<Return> result;
  for (const Eigen::Vector2d& p : returns) {
    const double distance = distanceFrom(footprint, p.x(), p.y());
    if (distance > -0.5 * footprint.inscribedRadius()) result.push_back({p, distance});
  }
  return result;
}

/// How near the footprint may come to a return that is `distance` away now, where the nearest of all is `least` away.
double nearestAllowed(double distance, double least, double margin) {
  const double nearest = std::clamp(least - kTolerance, std::min(kContact, margin), margin);
  if (distance >= kContact + kTolerance) return std::min(nearest, distance - kTolerance);
  // So near not even the tolerance is given: it would add up from step to step until the robot touches.
  return std::min({nearest, distance, kContact}) - 1e-6;
}

}  // namespace

bool touches(const std::vector<Pose2>& sweep, const ObstacleScan& scan, const Pose2& T_base_scan, const Footprint& footprint,
             double margin) {
  if (sweep.empty() || scan.ranges.empty()) return false;
  std::vector<Return> returns = withDistances(returnsIn(boundsOf(sweep, footprint, margin), scan, T_base_scan), footprint);
  double least = margin + kTolerance;
  for (const Return& r : returns) least = std::min(least, r.distance);
  for (Return& r : returns) r.distance = nearestAllowed(r.distance, least, margin);
  for (const Pose2& pose : sweep) {
    const double c = std::cos(pose.yaw), s = std::sin(pose.yaw);
    for (const Return& r : returns) {
      const double x = r.p_base.x() - pose.x, y = r.p_base.y() - pose.y;
      if (distanceFrom(footprint, c * x + s * y, c * y - s * x) < r.distance) return true;
    }
  }
  return false;
}

}  // namespace parley

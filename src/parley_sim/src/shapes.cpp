// SPDX-License-Identifier: BSD-3-Clause
#include "parley_sim/shapes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace parley::sim {
namespace {

constexpr double kTouch = 1e-9;  // [m] shapes that overlap by less are neighbours

/// Half the extent of a box along a unit vector. [m]
double reach(const Box& box, const Eigen::Vector2d& along) {
  const double on_axis = std::abs(box.axis.dot(along));
  const double across = std::abs(box.axis.x() * along.y() - box.axis.y() * along.x());
  return box.half_length * on_axis + box.half_width * across;
}

bool separatedAlong(const Eigen::Vector2d& along, const Box& a, const Box& b) {
  return std::abs((b.center - a.center).dot(along)) >= reach(a, along) + reach(b, along) - kTouch;
}

Eigen::Vector2d normalOf(const Box& box) { return {-box.axis.y(), box.axis.x()}; }

/// Narrows the crossing to one pair of parallel sides; false if nothing is left.
std::optional<Crossing> clip(const Crossing& so_far, double position, double slope, double half) {
  if (std::abs(slope) < 1e-12) {
    if (std::abs(position) > half) return std::nullopt;
    return so_far;
  }
  const double first = (-half - position) / slope, second = (half - position) / slope;
  const Crossing narrowed{std::max(so_far.enter, std::min(first, second)), std::min(so_far.leave, std::max(first, second))};
  if (narrowed.enter > narrowed.leave) return std::nullopt;
  return narrowed;
}

}  // namespace

double Box::circumradius() const { return std::hypot(half_length, half_width); }

Eigen::Vector2d Box::toLocal(const Eigen::Vector2d& point) const {
  const Eigen::Vector2d offset = point - center;
  return {axis.dot(offset), axis.x() * offset.y() - axis.y() * offset.x()};
}

std::array<Eigen::Vector2d, 4> Box::corners() const {
  const Eigen::Vector2d along = half_length * axis, across = half_width * normalOf(*this);
  return {center + along + across, center - along + across, center - along - across, center + along - across};
}

Box boxAt(const Pose2& pose, double length, double width) {
  return {pose.position(), pose.direction(), 0.5 * length, 0.5 * width};
}

Box boxOfSegment(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double thickness) {
  const Eigen::Vector2d along = b - a;
  const double length = along.norm();
  const Eigen::Vector2d axis = length > 0.0 ? Eigen::Vector2d(along / length) : Eigen::Vector2d::UnitX();
  return {0.5 * (a + b), axis, 0.5 * length, 0.5 * thickness};
}

bool overlap(const Box& a, const Box& b) {
  return !separatedAlong(a.axis, a, b) && !separatedAlong(normalOf(a), a, b) && !separatedAlong(b.axis, a, b) &&
         !separatedAlong(normalOf(b), a, b);
}

bool overlap(const Box& box, const Disc& disc) { return distance(box, disc.center) < disc.radius - kTouch; }

double distance(const Box& box, const Eigen::Vector2d& point) {
  const Eigen::Vector2d local = box.toLocal(point).cwiseAbs();
  return std::hypot(std::max(local.x() - box.half_length, 0.0), std::max(local.y() - box.half_width, 0.0));
}

double distance(const Box& a, const Box& b) {
  if (overlap(a, b)) return 0.0;
  // Two convex areas that are apart are nearest to each other at a corner of one of them.
  double nearest = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector2d& corner : a.corners()) nearest = std::min(nearest, distance(b, corner));
  for (const Eigen::Vector2d& corner : b.corners()) nearest = std::min(nearest, distance(a, corner));
  return nearest;
}

double distance(const Box& box, const Disc& disc) { return std::max(distance(box, disc.center) - disc.radius, 0.0); }

std::optional<Crossing> crossing(const Box& box, const Eigen::Vector2d& origin, const Eigen::Vector2d& direction) {
  const Eigen::Vector2d start = box.toLocal(origin);
  const Eigen::Vector2d slope = box.toLocal(box.center + direction);
  const Crossing all{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  const std::optional<Crossing> along = clip(all, start.x(), slope.x(), box.half_length);
  return along ? clip(*along, start.y(), slope.y(), box.half_width) : std::nullopt;
}

std::optional<Crossing> crossing(const Disc& disc, const Eigen::Vector2d& origin, const Eigen::Vector2d& direction) {
  const Eigen::Vector2d offset = origin - disc.center;
  const double half_slope = offset.dot(direction);
  const double discriminant = half_slope * half_slope - offset.squaredNorm() + disc.radius * disc.radius;
  if (discriminant < 0.0) return std::nullopt;
  const double root = std::sqrt(discriminant);
  return Crossing{-half_slope - root, -half_slope + root};
}

}  // namespace parley::sim

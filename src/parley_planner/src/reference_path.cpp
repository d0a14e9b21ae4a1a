// SPDX-License-Identifier: BSD-3-Clause
#include "reference_path.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "banded_system.h"
#include "parley_geometry/angles.h"

namespace parley {

namespace {

constexpr double kMovingSpeed = 0.3;  // [m/s] faster than this the curvature that is being driven is kept at the start
constexpr double kInertia = 0.02;     // [-] against steps, beside a push of one: keeps flat directions still
constexpr double kLongestStep = 0.1;  // [m] of a point at once, so that none jumps over an obstacle

// Unknowns are the points' coordinates, x and y in turn: third differences reach three points, seven entries, away.
using Band = BandedSystem<7>;

/// Adds weight * |sum of coefficients times points|^2 for `coefficients` from point `first` on; fixed points go to the right.
void addDifference(Band* system, const Path& points, std::size_t fixed, std::size_t first,
                   const std::vector<double>& coefficients, double weight) {
  const std::size_t free = system->size() / 2;
  const auto isFree = [&](std::size_t point) { return point >= fixed && point < fixed + free; };
  for (std::size_t i = 0; i < coefficients.size(); ++i) {
    if (!isFree(first + i)) continue;
    const std::size_t row = 2 * (first + i - fixed);
    for (std::size_t j = 0; j < coefficients.size(); ++j) {
      const double entry = weight * coefficients[i] * coefficients[j];
      for (std::size_t axis = 0; axis < 2; ++axis) {
        if (!isFree(first + j)) system->addRight(row + axis, -entry * points[first + j][static_cast<Eigen::Index>(axis)]);
        if (isFree(first + j) && j >= i) system->add(row + axis, 2 * (first + j - fixed) + axis, entry);
      }
    }
  }
}

/// Adds the push of obstacles on a free point, linearised where it is: (lack - gradient . step)^2, and `inertia` * step^2.
void addPush(Band* system, const Eigen::Vector2d& point, std::size_t row, const DistanceField& obstacles, double push_distance,
             double inertia) {
  const DistanceField::Sample sample = obstacles.sample(point);
  const double lack = push_distance - sample.distance, steepness = sample.gradient.norm();
  Eigen::Matrix2d matrix = inertia * Eigen::Matrix2d::Identity();
  Eigen::Vector2d right = inertia * point;
  if (lack > 0.0 && steepness > 0.2) {
    const Eigen::Vector2d away = sample.gradient / steepness;
    matrix += away * away.transpose();
    right += away * (away.dot(point) + lack);
  }
  system->add(row, row, matrix(0, 0));
  system->add(row, row + 1, matrix(0, 1));
  system->add(row + 1, row + 1, matrix(1, 1));
  system->addRight(row, right.x());
  system->addRight(row + 1, right.y());
}

/// One Gauss-Newton step, no point moved further than `kLongestStep`.
Path stepped(const Path& points, std::size_t fixed, const DistanceField& obstacles, const SmoothingOptions& options) {
  const std::size_t free = points.size() - fixed - 1;  // the end is fixed too
  Band system(2 * free);
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    addDifference(&system, points, fixed, i, {-1.0, 1.0}, options.tension_weight);
  }
  for (std::size_t i = 0; i + 2 < points.size(); ++i) {
    addDifference(&system, points, fixed, i, {1.0, -2.0, 1.0}, options.bending_weight);
  }
  for (std::size_t i = 0; i + 3 < points.size(); ++i) {
    addDifference(&system, points, fixed, i, {-1.0, 3.0, -3.0, 1.0}, options.twisting_weight);
  }
  for (std::size_t k = 0; k < free; ++k) {
    addPush(&system, points[fixed + k], 2 * k, obstacles, options.push_distance, kInertia);
  }
  const std::vector<double> solution = std::move(system).solve();
  Path result = points;
  for (std::size_t k = 0; k < free; ++k) {
    const Eigen::Vector2d step = Eigen::Vector2d(solution[2 * k], solution[2 * k + 1]) - points[fixed + k];
    result[fixed + k] += step * std::min(1.0, kLongestStep / std::max(1e-12, step.norm()));
  }
  return result;
}

}  // namespace

ReferencePath::ReferencePath(Path points) : points_(std::move(points)) {
  assert(points_.size() >= 2);
  const std::size_t n = points_.size();
  arc_lengths_.assign(n, 0.0);
  yaws_.assign(n, 0.0);
  curvatures_.assign(n, 0.0);
  std::vector<double> segment_yaws(n - 1);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const Eigen::Vector2d step = points_[i + 1] - points_[i];
    arc_lengths_[i + 1] = arc_lengths_[i] + step.norm();
    segment_yaws[i] = std::atan2(step.y(), step.x());
  }
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double turn = angleBetween(segment_yaws[i - 1], segment_yaws[i]);
    yaws_[i] = wrapAngle(segment_yaws[i - 1] + 0.5 * turn);
    curvatures_[i] = 2.0 * turn / (arc_lengths_[i + 1] - arc_lengths_[i - 1]);
  }
  curvatures_.front() = n > 2 ? curvatures_[1] : 0.0;
  curvatures_.back() = n > 2 ? curvatures_[n - 2] : 0.0;
  yaws_.front() = n > 2 ? wrapAngle(segment_yaws.front() - 0.5 * curvatures_.front() * arc_lengths_[1]) : segment_yaws[0];
  yaws_.back() = segment_yaws.back();
}

std::size_t ReferencePath::segmentAt(double s) const {
  const auto after = std::upper_bound(arc_lengths_.begin() + 1, arc_lengths_.end() - 1, s);
  return static_cast<std::size_t>(after - arc_lengths_.begin()) - 1;
}

ReferencePath::Point ReferencePath::at(double s) const {
  const std::size_t i = segmentAt(s);
  const double span = arc_lengths_[i + 1] - arc_lengths_[i];
  const double f = std::clamp((s - arc_lengths_[i]) / span, 0.0, 1.0);
  return {points_[i] + f * (points_[i + 1] - points_[i]), wrapAngle(yaws_[i] + f * angleBetween(yaws_[i], yaws_[i + 1])),
          curvatures_[i] + f * (curvatures_[i + 1] - curvatures_[i])};
}

double ReferencePath::project(const Eigen::Vector2d& p, double near_s, double reach) const {
  double best_s = near_s, best = 1e30;
  for (std::size_t i = segmentAt(near_s - reach); i + 1 < points_.size() && arc_lengths_[i] <= near_s + reach; ++i) {
    const Eigen::Vector2d step = points_[i + 1] - points_[i];
    const double f = std::clamp((p - points_[i]).dot(step) / step.squaredNorm(), 0.0, 1.0);
    const double distance = (points_[i] + f * step - p).squaredNorm();
    if (distance < best) {
      best = distance;
      best_s = arc_lengths_[i] + f * (arc_lengths_[i + 1] - arc_lengths_[i]);
    }
  }
  return best_s;
}

Path leadIn(const PathStart& start, double spacing) {
  const double curvature = start.speed > kMovingSpeed ? start.turn_rate / start.speed : 0.0;
  Path points;
  for (int i = 2; i >= 0; --i) points.push_back(integrateTwist(start.pose, -1.0, -curvature, i * spacing).position());
  return points;
}

ReferencePath smoothed(const Path& path, const PathStart& start, const DistanceField& obstacles,
                       const SmoothingOptions& options) {
  Path points = leadIn(start, options.spacing);
  const std::size_t fixed = points.size();
  const Path rest = resampled(path, options.spacing);
  points.insert(points.end(), rest.begin() + 1, rest.end());
  if (rest.size() < 4) return ReferencePath(points);
  for (int k = 0; k < options.iterations; ++k) points = stepped(points, fixed, obstacles, options);
  return ReferencePath(points);
}

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#include "parley_geometry/trajectory.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace parley {
namespace {

TrajectoryPoint between(const TrajectoryPoint& a, const TrajectoryPoint& b, double time) {
  const double span = b.time - a.time;
  const double f = span > 0.0 ? (time - a.time) / span : 1.0;
  return {time, interpolate(a.pose, b.pose, f),
          Twist2{a.twist.speed + f * (b.twist.speed - a.twist.speed),
                 a.twist.turn_rate + f * (b.twist.turn_rate - a.twist.turn_rate)}};
}

double towardsZero(double value, double step) { return value > 0.0 ? std::max(0.0, value - step) : std::min(0.0, value + step); }

}  // namespace

SampledTrajectory::SampledTrajectory(std::vector<TrajectoryPoint> points) : points_(std::move(points)) {
  assert(std::is_sorted(points_.begin(), points_.end(),
                        [](const TrajectoryPoint& a, const TrajectoryPoint& b) { return a.time < b.time; }));
}

TrajectoryPoint SampledTrajectory::at(double time) const {
  assert(!points_.empty());
  if (time < points_.front().time) return {time, points_.front().pose, {}};
  if (time > points_.back().time) return {time, points_.back().pose, {}};
  const auto after =
      std::lower_bound(points_.begin(), points_.end(), time, [](const TrajectoryPoint& p, double t) { return p.time < t; });
  return after == points_.begin() ? *after : between(*std::prev(after), *after, time);
}

double SampledTrajectory::length() const {
  double sum = 0.0;
  for (std::size_t i = 1; i < points_.size(); ++i) {
    sum += (points_[i].pose.position() - points_[i - 1].pose.position()).norm();
  }
  return sum;
}

SampledTrajectory SampledTrajectory::from(double time) const {
  if (empty()) return {};
  std::vector<TrajectoryPoint> rest{at(time)};
  for (const TrajectoryPoint& point : points_) {
    if (point.time > time) rest.push_back(point);
  }
  return SampledTrajectory(std::move(rest));
}

SampledTrajectory SampledTrajectory::standing(const Pose2& pose, double time) { return SampledTrajectory({{time, pose, {}}}); }

SampledTrajectory brakingTrajectory(const TrajectoryPoint& from, const MotionLimits& limits, double time_step,
                                    const CurvatureLaw& curvature) {
  assert(time_step > 0.0 && limits.acceleration > 0.0 && limits.turn_acceleration > 0.0);
  std::vector<TrajectoryPoint> points{from};
  while (points.back().twist.speed != 0.0 || points.back().twist.turn_rate != 0.0) {
    TrajectoryPoint p = points.back();
    const Twist2 before = p.twist;
    p.twist.speed = towardsZero(before.speed, limits.acceleration * time_step);
    const double fastest = std::max(limits.turn_rate, std::abs(before.turn_rate));
    const double wanted = std::clamp(curvature(before, p.twist.speed) * p.twist.speed, -fastest, fastest);
    const double change = limits.turn_acceleration * time_step;
    p.twist.turn_rate = std::clamp(wanted, before.turn_rate - change, before.turn_rate + change);
    p.pose =
        integrateTwist(p.pose, 0.5 * (before.speed + p.twist.speed), 0.5 * (before.turn_rate + p.twist.turn_rate), time_step);
    p.time += time_step;
    points.push_back(p);
  }
  return SampledTrajectory(std::move(points));
}

SampledTrajectory brakingTrajectory(const TrajectoryPoint& from, const MotionLimits& limits, double time_step) {
  return brakingTrajectory(from, limits, time_step, [](const Twist2& before, double) {
    return std::abs(before.speed) > 1e-9 ? before.turn_rate / before.speed : 0.0;
  });
}

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#include "parley_geometry/piecewise_quintic.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace parley {

namespace {

constexpr double kStanding = 1e-3;  // [m/s] below this the direction of the velocity says nothing

}  // namespace

PiecewiseQuintic::PiecewiseQuintic(const std::vector<FlatState>& knots, double duration) : duration_(duration) {
  assert(knots.size() >= 2 && duration > 0.0);
  const double each = duration / static_cast<double>(knots.size() - 1);
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) pieces_.push_back(QuinticPiece::between(knots[i], knots[i + 1], each));
}

PiecewiseQuintic::Place PiecewiseQuintic::placeOf(double t) const {
  assert(!empty());
  const double each = pieces_.front().duration();
  const double clamped = std::clamp(t, 0.0, duration_);
  const std::size_t piece = std::min(pieces_.size() - 1, static_cast<std::size_t>(clamped / each));
  return {piece, std::clamp(clamped - static_cast<double>(piece) * each, 0.0, each)};
}

FlatState PiecewiseQuintic::at(double t) const {
  const Place place = placeOf(t);
  return pieces_[place.piece].at(place.t);
}

Eigen::Vector2d PiecewiseQuintic::jerk(double t) const {
  const Place place = placeOf(t);
  return pieces_[place.piece].jerk(place.t);
}

double PiecewiseQuintic::jerkCost() const {
  double sum = 0.0;
  for (const QuinticPiece& piece : pieces_) sum += piece.jerkCost();
  return sum;
}

SampledTrajectory PiecewiseQuintic::sampled(double start_time, double time_step, double initial_yaw, bool reverse) const {
  assert(time_step > 0.0);
  std::vector<TrajectoryPoint> points;
  double yaw = initial_yaw;
  const double sign = reverse ? -1.0 : 1.0;
  const int steps = static_cast<int>(std::ceil(duration_ / time_step - 1e-9));
  for (int i = 0; i <= steps; ++i) {
    const double t = std::min(i * time_step, duration_);
    const FlatState state = at(t);
    const double speed = state.velocity.norm();
    double turn_rate = 0.0;
    if (speed > kStanding) {
      yaw = std::atan2(sign * state.velocity.y(), sign * state.velocity.x());
      turn_rate = (state.velocity.x() * state.acceleration.y() - state.velocity.y() * state.acceleration.x()) / (speed * speed);
    }
    points.push_back({start_time + t, {state.position.x(), state.position.y(), yaw}, {sign * speed, turn_rate}});
  }
  return SampledTrajectory(std::move(points));
}

}  // namespace parley

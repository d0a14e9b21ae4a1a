// SPDX-License-Identifier: BSD-3-Clause
#include "parley_geometry/twist_estimator.h"

#include <cassert>
#include <cmath>

namespace parley {
namespace {

constexpr double kHaste = 1.5;       // [-] of the limits: a drive may be a little faster than it is said to be
constexpr double kDeviations = 5.0;  // [-] of noise

/// Length of the arc between two poses, negative backwards.
double wayBetween(const Pose2& from, const Pose2& to, double turn) {
  const Pose2 middle{0.0, 0.0, from.yaw + 0.5 * turn};
  const double chord = middle.direction().dot(to.position() - from.position());
  const double half = 0.5 * turn;
  return std::abs(half) < 1e-6 ? chord : chord * half / std::sin(half);
}

}  // namespace

TwistEstimator::Axis TwistEstimator::Axis::started(double noise, double highest_rate) {
  return {0.0, 0.0, noise * noise, 0.0, highest_rate * highest_rate};
}

void TwistEstimator::Axis::predict(double dt, double acceleration) {
  const double variance = acceleration * acceleration * dt * dt;
  way += rate * dt;
  way_way += dt * (2.0 * way_rate + dt * rate_rate) + 0.25 * variance * dt * dt;
  way_rate += dt * rate_rate + 0.5 * variance * dt;
  rate_rate += variance;
}

void TwistEstimator::Axis::update(double measured, double noise) {
  const double innovation = measured - way;
  const double variance = way_way + noise * noise;
  const double gain_way = way_way / variance, gain_rate = way_rate / variance;
  way += gain_way * innovation;
  rate += gain_rate * innovation;
  rate_rate -= gain_rate * way_rate;
  way_rate *= 1.0 - gain_way;
  way_way *= 1.0 - gain_way;
}

void TwistEstimator::start(double stamp, const Pose2& pose) {
  past_ = {{stamp, pose}};
  way_ = turned_ = 0.0;
  along_ = Axis::started(options_.position_noise, limits_.speed);
  heading_ = Axis::started(options_.rotation_noise, limits_.turn_rate);
}

std::optional<Twist2> TwistEstimator::add(double stamp, const Pose2& pose) {
  assert(past_.empty() || stamp > past_.back().stamp);
  if (past_.empty() || stamp - past_.back().stamp > options_.longest_gap) {
    start(stamp, pose);
    return std::nullopt;
  }
  const Stamped last = past_.back();
  const double dt = stamp - last.stamp;
  const double turn = angleBetween(last.pose.yaw, pose.yaw);
  const double step = (pose.position() - last.pose.position()).norm();
  along_.predict(dt, limits_.acceleration);
  heading_.predict(dt, limits_.turn_acceleration);
  if (step > kHaste * limits_.speed * dt + kDeviations * options_.position_noise ||
      std::abs(turn) > kHaste * limits_.turn_rate * dt + kDeviations * options_.rotation_noise) {
    ++corrections_;
    if (past_.size() == 1) {  // right after the start or another one: nothing is known of the velocity
      start(stamp, pose);
      return std::nullopt;
    }
    way_ = along_.way;
    turned_ = heading_.way;
    past_.clear();  // what was before is not where it seemed
  } else {
    way_ += wayBetween(last.pose, pose, turn);
    turned_ += turn;
    along_.update(way_, options_.position_noise);
    heading_.update(turned_, options_.rotation_noise);
  }
  past_.push_back({stamp, pose});
  while (past_.size() > 2 && past_[1].stamp <= stamp - options_.standing_time) past_.pop_front();
  return stands() ? Twist2{} : Twist2{along_.rate, heading_.rate};
}

/// Whether the place was kept for the whole standing time.
bool TwistEstimator::stands() const {
  const Stamped& now = past_.back();
  if (past_.front().stamp > now.stamp - options_.standing_time) return false;
  for (const Stamped& then : past_) {
    if ((now.pose.position() - then.pose.position()).norm() > options_.standing_distance ||
        std::abs(angleBetween(then.pose.yaw, now.pose.yaw)) > options_.standing_angle) {
      return false;
    }
  }
  return true;
}

}  // namespace parley

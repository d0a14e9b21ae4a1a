// SPDX-License-Identifier: BSD-3-Clause
#include "parley_geometry/odometry_buffer.h"

#include <algorithm>
#include <cmath>

namespace parley {
namespace {

constexpr double kTimeReset = 1.0;      // [s] going back by more than this means that time started again
constexpr double kExtrapolation = 0.1;  // [s]

bool isFinite(const Odometry& o) {
  return std::isfinite(o.stamp) && o.pose.isFinite() && std::isfinite(o.twist.speed) && std::isfinite(o.twist.turn_rate) &&
         std::isfinite(o.roll) && std::isfinite(o.pitch);
}

Odometry between(const Odometry& a, const Odometry& b, double time) {
  const double span = b.stamp - a.stamp;
  const double f = span > 0.0 ? (time - a.stamp) / span : 0.0;
  const auto mix = [f](double from, double to) { return from + f * (to - from); };
  return {time, interpolate(a.pose, b.pose, f),
          Twist2{mix(a.twist.speed, b.twist.speed), mix(a.twist.turn_rate, b.twist.turn_rate)}, mix(a.roll, b.roll),
          mix(a.pitch, b.pitch)};
}

}  // namespace

OdometryBuffer::OdometryBuffer(double horizon, std::size_t capacity, double jump_distance, double jump_angle)
    : horizon_(horizon), capacity_(capacity), jump_distance_(jump_distance), jump_angle_(jump_angle) {}

bool OdometryBuffer::jumps(const Odometry& from, const Odometry& to) const {
  if (to.stamp - from.stamp > 1.0) return false;
  return (to.pose.position() - from.pose.position()).norm() > jump_distance_ ||
         std::abs(angleBetween(from.pose.yaw, to.pose.yaw)) > jump_angle_;
}

OdometryVerdict OdometryBuffer::add(const Odometry& reading) {
  if (!isFinite(reading)) return OdometryVerdict::kNotFinite;
  OdometryVerdict verdict = OdometryVerdict::kAccepted;
  if (!readings_.empty()) {
    const double step = reading.stamp - readings_.back().stamp;
    if (step < -kTimeReset) {
      readings_.clear();
      verdict = OdometryVerdict::kTimeWentBack;
    } else if (step <= 0.0) {
      return OdometryVerdict::kOutOfOrder;
    } else if (jumps(readings_.back(), reading)) {
      readings_.clear();
      verdict = OdometryVerdict::kJumped;
    }
  }
  readings_.push_back(reading);
  while (readings_.size() > capacity_ || readings_.front().stamp < reading.stamp - horizon_) readings_.pop_front();
  return verdict;
}

std::optional<Odometry> OdometryBuffer::at(double time) const {
  if (readings_.empty() || !std::isfinite(time) || time < readings_.front().stamp) return std::nullopt;
  const Odometry& newest = readings_.back();
  if (time > newest.stamp) {
    if (time > newest.stamp + kExtrapolation) return std::nullopt;
    Odometry ahead = newest;
    ahead.stamp = time;
    ahead.pose = integrateTwist(newest.pose, newest.twist.speed, newest.twist.turn_rate, time - newest.stamp);
    return ahead;
  }
  const auto after =
      std::lower_bound(readings_.begin(), readings_.end(), time, [](const Odometry& o, double t) { return o.stamp < t; });
  if (after == readings_.begin() || after->stamp == time) return *after;
  return between(*std::prev(after), *after, time);
}

}  // namespace parley

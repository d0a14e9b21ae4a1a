// SPDX-License-Identifier: BSD-3-Clause
#include "motion_history.h"

#include <algorithm>
#include <cmath>

namespace parley {
namespace {

constexpr double kLongestGap = 1.2;     // [s]
constexpr double kLongestAhead = 0.3;   // [s]
constexpr double kSame = 1e-3;          // [s]
constexpr double kAcceleration = 3.0;   // [m/s^2] what a robot may do between two readings
constexpr double kWithSpeeds = 0.1;     // [-] share of what that makes possible
constexpr double kWithoutSpeeds = 0.2;  // [-]

bool isEarlier(const TimedPose& reading, double stamp) { return reading.stamp < stamp; }

/// Cubic through both ends with their velocities, which point where the robot does. Where a speed is not known, it is the mean
/// one.
MotionAt between(const TimedPose& a, const TimedPose& b, double time) {
  const double gap = b.stamp - a.stamp, u = (time - a.stamp) / gap, rest = gap * std::min(u, 1.0 - u);
  const Eigen::Vector2d pa = a.pose.position(), pb = b.pose.position();
  const auto way = [&](const TimedPose& end) -> Eigen::Vector2d {  // [m] at the end's velocity
    const Eigen::Vector2d ahead = end.pose.direction();
    return (end.has_speed ? end.speed * gap : (pb - pa).dot(ahead)) * ahead;
  };
  const Eigen::Vector2d va = way(a), vb = way(b);
  const double u2 = u * u, u3 = u2 * u;
  const Eigen::Vector2d p = (2 * u3 - 3 * u2 + 1) * pa + (u3 - 2 * u2 + u) * va + (3 * u2 - 2 * u3) * pb + (u3 - u2) * vb;
  MotionAt result;
  result.velocity = ((6 * u2 - 6 * u) * (pa - pb) + (3 * u2 - 4 * u + 1) * va + (3 * u2 - 2 * u) * vb) / gap;
  result.pose = {p.x(), p.y(), interpolate(a.pose, b.pose, u).yaw};
  result.deviation = (a.has_speed && b.has_speed ? kWithSpeeds : kWithoutSpeeds) * kAcceleration * gap * rest;
  return result;
}

}  // namespace

void MotionHistory::add(const TimedPose& reading) {
  const auto place = std::lower_bound(readings_.begin(), readings_.end(), reading.stamp - kSame, isEarlier);
  if (place != readings_.end() && place->stamp <= reading.stamp + kSame) {
    if (reading.has_speed) *place = reading;
    return;
  }
  readings_.insert(place, reading);
  if (readings_.size() > capacity_) readings_.pop_front();
}

void MotionHistory::forgetBefore(double stamp) {
  while (!readings_.empty() && readings_.front().stamp < stamp) readings_.pop_front();
}

std::optional<MotionAt> MotionHistory::at(double time) const {
  const auto after = std::lower_bound(readings_.begin(), readings_.end(), time, isEarlier);
  if (after != readings_.end() && after->stamp - time < kSame) {
    return MotionAt{after->pose, velocityAt(after - readings_.begin()), 0.0};
  }
  if (after == readings_.begin()) return std::nullopt;
  const TimedPose& before = *std::prev(after);
  if (time - before.stamp < kSame) return MotionAt{before.pose, velocityAt(after - readings_.begin() - 1), 0.0};
  if (after != readings_.end()) {
    if (after->stamp - before.stamp > kLongestGap) return std::nullopt;
    return between(before, *after, time);
  }
  const double ahead = time - before.stamp;
  if (ahead > kLongestAhead || !before.has_speed) return std::nullopt;
  const Pose2 pose = integrateTwist(before.pose, before.speed, before.turn_rate, ahead);
  return MotionAt{pose, before.speed * pose.direction(), 0.25 * kAcceleration * ahead * ahead};
}

/// By the reading itself, or from the readings beside it. [m/s]
Eigen::Vector2d MotionHistory::velocityAt(long index) const {
  const TimedPose& here = readings_[static_cast<std::size_t>(index)];
  if (here.has_speed) return here.speed * here.pose.direction();
  const TimedPose& before = readings_[static_cast<std::size_t>(std::max(index - 1, 0L))];
  const TimedPose& after = readings_[std::min(static_cast<std::size_t>(index) + 1, readings_.size() - 1)];
  const double gap = after.stamp - before.stamp;
  if (gap <= 0.0 || gap > kLongestGap) return Eigen::Vector2d::Zero();
  return (after.pose.position() - before.pose.position()) / gap;
}

double MotionHistory::travel(double from, double to) const {
  const auto start = at(from), end = at(to);
  if (!start || !end) return 0.0;
  double length = 0.0;
  Eigen::Vector2d last = start->pose.position();
  for (auto it = std::lower_bound(readings_.begin(), readings_.end(), from, isEarlier); it != readings_.end() && it->stamp < to;
       ++it) {
    length += (it->pose.position() - last).norm();
    last = it->pose.position();
  }
  return length + (end->pose.position() - last).norm();
}

}  // namespace parley

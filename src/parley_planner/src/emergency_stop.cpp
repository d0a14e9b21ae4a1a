// SPDX-License-Identifier: BSD-3-Clause
#include "emergency_stop.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

namespace parley {

namespace {

constexpr double kSlow = 0.05;     // [m/s] a slower reference's curvature says nothing
constexpr double kContact = 0.01;  // [m] nearer than this counts as touching

/// How fast a stop is where it first touches what stands, and where it first touches what moves; zero where it does not.
/// Compared in this order: a wall is where it is, but what moves may brake or leave, and its disc is larger than itself.
struct Contacts {
  double standing = 0.0;  // [m/s]
  double moving = 0.0;    // [m/s]
  bool operator<(const Contacts& other) const { return std::tie(standing, moving) < std::tie(other.standing, other.moving); }
};

Contacts contactsOf(const TrajectoryValidator& validator, const SampledTrajectory& stop) {
  const auto speedAt = [&](const Verdict& verdict) {
    return verdict.good() ? 0.0 : std::abs(stop.at(verdict.time).twist.speed) + kSlow;
  };
  return {speedAt(validator.checkObstacles(stop.points(), {kContact, 0.0, 0.0})),
          std::max(speedAt(validator.checkTracks(stop.points())), speedAt(validator.checkPeers(stop.points())))};
}

}  // namespace

SampledTrajectory brakingAlong(const SampledTrajectory& path, const TrajectoryPoint& from, const MotionLimits& limits,
                               double time_step) {
  double path_time = from.time;
  return brakingTrajectory(from, limits, time_step, [&](const Twist2& before, double speed_after) {
    const auto reference = [&](double time) {
      const Twist2 twist = path.at(time).twist;
      return std::abs(twist.speed) > kSlow && twist.speed * before.speed > 0.0 ? std::optional<Twist2>(twist) : std::nullopt;
    };
    // The middle of the step and its end: a stop that is begun anew with each plan would add up what the start is off by.
    const double driven = time_step * 0.5 * (before.speed + speed_after);
    const std::optional<Twist2> start = reference(path_time);
    const std::optional<Twist2> middle = start ? reference(path_time + 0.5 * driven / start->speed) : std::nullopt;
    if (middle) path_time += driven / middle->speed;
    const std::optional<Twist2> end = middle ? reference(path_time) : std::nullopt;
    if (end) return end->turn_rate / end->speed;
    return before.speed != 0.0 ? before.turn_rate / before.speed : 0.0;
  });
}

SampledTrajectory safestStop(const TrajectoryValidator& validator, const SampledTrajectory& committed,
                             const TrajectoryPoint& from, const MotionLimits& limits, double time_step) {
  std::vector<SampledTrajectory> choices;
  if (!committed.empty()) choices.push_back(brakingAlong(committed, from, limits, time_step));
  choices.push_back(brakingTrajectory(from, limits, time_step));
  choices.push_back(brakingTrajectory(from, limits, time_step, [](const Twist2&, double) { return 0.0; }));
  return *std::min_element(choices.begin(), choices.end(), [&](const SampledTrajectory& a, const SampledTrajectory& b) {
    return contactsOf(validator, a) < contactsOf(validator, b);
  });
}

}  // namespace parley

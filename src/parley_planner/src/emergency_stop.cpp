// SPDX-License-Identifier: BSD-3-Clause
#include "emergency_stop.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace parley {

namespace {

constexpr double kSlow = 0.05;     // [m/s] a slower reference's curvature says nothing
constexpr double kContact = 0.01;  // [m] nearer than this counts as touching

/// Speed at the first touch; zero if there is none. [m/s]
double speedAtContact(const TrajectoryValidator& validator, const SampledTrajectory& trajectory) {
  const Verdict verdict = validator.checkRest(trajectory, trajectory.startTime(), {kContact, 0.0, 0.0});
  const bool touches = verdict.flaw == Flaw::kObstacle || verdict.flaw == Flaw::kTrack;
  return touches ? std::abs(trajectory.at(verdict.time).twist.speed) + kSlow : 0.0;
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
  const auto slowest =
      std::min_element(choices.begin(), choices.end(), [&](const SampledTrajectory& a, const SampledTrajectory& b) {
        return speedAtContact(validator, a) < speedAtContact(validator, b);
      });
  return *slowest;
}

}  // namespace parley

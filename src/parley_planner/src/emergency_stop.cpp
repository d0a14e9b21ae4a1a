// SPDX-License-Identifier: BSD-3-Clause
#include "emergency_stop.h"

#include <algorithm>
#include <cmath>

namespace parley {

namespace {

constexpr double kSlow = 0.05;     // [m/s] a slower reference's curvature says nothing
constexpr double kContact = 0.01;  // [m] nearer than this counts as touching

/// Speed at the first touch; zero if there is none. [m/s]
double speedAtContact(const TrajectoryValidator& validator, const SampledTrajectory& trajectory) {
  const Verdict verdict = validator.checkRest(trajectory, trajectory.startTime(), {kContact, 0.0, 0.0});
  const bool touches = verdict.flaw == Flaw::kObstacle || verdict.flaw == Flaw::kTrack || verdict.flaw == Flaw::kPeer;
  return touches ? std::abs(trajectory.at(verdict.time).twist.speed) + kSlow : 0.0;
}

}  // namespace

SampledTrajectory brakingAlong(const SampledTrajectory& path, const TrajectoryPoint& from, const MotionLimits& limits,
                               double time_step) {
  double path_time = from.time;
  return brakingTrajectory(from, limits, time_step, [&](const Twist2& before, double speed_after) {
    double curvature = before.speed != 0.0 ? before.turn_rate / before.speed : 0.0;
    const Twist2 reference = path.at(path_time).twist;
    if (std::abs(reference.speed) > kSlow && reference.speed * before.speed > 0.0) {
      curvature = reference.turn_rate / reference.speed;
      path_time += time_step * 0.5 * (before.speed + speed_after) / reference.speed;
    }
    return curvature;
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

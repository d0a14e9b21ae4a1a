// SPDX-License-Identifier: BSD-3-Clause
#include "pace.h"

#include <algorithm>
#include <cmath>

#include "section_codec.h"

namespace parley {
namespace {

constexpr double kConflictInterval = 0.1;  // [s]
constexpr int kConflictSends = 3;          // [-] times a change of mind is sent without waiting
constexpr double kTogether = 0.4;          // [-] what is due within this part of its period goes along
constexpr double kStep = 0.25;             // [s] of trajectories on the air, longer for very long ones
constexpr double kYawTolerance = 0.1;      // [rad]
constexpr double kWayTolerance = 1.0;      // [m]
constexpr double kIntentInterval = 0.5;    // [s] at which the same intent is told again with a trajectory,
constexpr int kIntentSends = 3;            // [-] after a change of right of way so often with the next one
constexpr double kSlack = 1e-6;            // [s]

/// Whether something that is due every `period` seconds is due now, or soon enough to go with something else.
bool isDue(double last, double period, double now, bool early) {
  return now - last >= period * (early ? 1.0 - kTogether : 1.0) - kSlack || now < last;
}

}  // namespace

void Pace::intentIs(const IntentMessage& intent) {
  const IntentMessage &a = intent, &b = intent_;
  if (a.holder != b.holder || a.depth != b.depth || a.priority != b.priority) intent_sends_ = kIntentSends;
  intent_ = intent;
}

bool Pace::intentChanged() const {
  const IntentMessage &a = intent_, &b = sent_intent_;
  if (a.way.empty()) return false;
  if (b.way.empty() || a.holder != b.holder || a.depth != b.depth || a.priority != b.priority) return true;
  return (a.way.back() - b.way.back()).norm() > kWayTolerance;
}

void Pace::setConflicts(const std::vector<Conflict>& conflicts) {
  const auto same = [](const Conflict& a, const Conflict& b) {
    return a.peer == b.peer && a.kind == b.kind && a.round == b.round && a.place.has_value() == b.place.has_value();
  };
  if (!std::equal(conflicts.begin(), conflicts.end(), conflicts_.begin(), conflicts_.end(), same))
    conflict_sends_ = kConflictSends;
  conflicts_ = conflicts;
}

bool Pace::trajectoryChanged(double now) const {
  if (trajectory_.empty() || sent_trajectory_.empty()) return trajectory_.empty() != sent_trajectory_.empty();
  const double end = std::max(trajectory_.endTime(), sent_trajectory_.endTime());
  for (double time = now; time < end + kStep; time += kStep) {
    const Pose2 a = trajectory_.at(time).pose, b = sent_trajectory_.at(time).pose;
    if ((a.position() - b.position()).norm() > options_.trajectory_tolerance) return true;
    if (std::abs(angleBetween(a.yaw, b.yaw)) > kYawTolerance) return true;
  }
  return false;
}

double Pace::jitter() const {
  // So that two robots that started together do not talk at the same instant for ever.
  const std::uint32_t hash = (self_ + beacons_ * 2654435761U) * 2246822519U;
  return 0.9 + 0.2 * static_cast<double>(hash >> 16) / 65536.0;
}

Agenda Pace::agenda(double now, double beacon_rate) const {
  Agenda agenda;
  const bool has_trajectory = !trajectory_.empty();
  const double beacon_period = jitter() / beacon_rate;
  agenda.beacon = isDue(beacon_time_, beacon_period, now, false);
  agenda.conflicts = conflict_sends_ > 0 && isDue(conflict_time_, kConflictInterval, now, false);
  const bool may = has_trajectory && isDue(trajectory_time_, 1.0 / options_.trajectory_rate_max, now, false);
  const bool changed = intentChanged() || trajectoryChanged(now);
  agenda.trajectory = may && (changed || isDue(trajectory_time_, 1.0 / options_.trajectory_rate_min, now, false));
  agenda.intent =
      !intent_.way.empty() && (intentChanged() || intent_sends_ > 0 || isDue(intent_time_, kIntentInterval, now, true));
  if (agenda.empty()) return agenda;
  agenda.trajectory = agenda.trajectory || (may && isDue(trajectory_time_, 1.0 / options_.trajectory_rate_min, now, true));
  agenda.beacon = agenda.beacon || isDue(beacon_time_, beacon_period, now, true);
  agenda.conflicts = agenda.conflicts || conflict_sends_ > 0 || !conflicts_.empty();
  agenda.full_beacon = agenda.beacon && isDue(full_time_, 1.0 / options_.beacon_rate_min, now, true);
  return agenda;
}

void Pace::sent(const Agenda& done, double now) {
  if (done.trajectory) {
    trajectory_time_ = now;
    sent_trajectory_ = trajectory_;
  }
  if (done.intent) {
    intent_time_ = now;
    sent_intent_ = intent_;
    intent_sends_ = std::max(0, intent_sends_ - 1);
  }
  if (done.conflicts) {
    conflict_time_ = now;
    conflict_sends_ = std::max(0, conflict_sends_ - 1);
  }
  if (done.beacon) {
    beacon_time_ = now;
    ++beacons_;
  }
  if (done.full_beacon) full_time_ = now;
}

TrajectoryMessage trajectoryMessage(const SampledTrajectory& trajectory, DriveState state, double now) {
  TrajectoryMessage message;
  message.state = state;
  const double start = std::clamp(trajectory.startTime(), now, now + 20.0);
  const double duration = std::max(0.0, trajectory.endTime() - start);
  const double steps = std::min(std::ceil(duration / kStep - 1e-6), static_cast<double>(kMaxPoses - 1));
  // To the wire's hundredths, upwards, so that the last pose is the end.
  message.step = steps > 0.0 ? std::clamp(std::ceil(duration / steps * 100.0 - 1e-6) / 100.0, 0.01, 2.55) : kStep;
  message.start = start - now;
  for (double i = 0.0; i <= steps; i += 1.0) message.poses.push_back(trajectory.at(start + i * message.step).pose);
  return message;
}

}  // namespace parley

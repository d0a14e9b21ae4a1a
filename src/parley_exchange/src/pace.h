// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "parley_exchange/exchange_options.h"
#include "parley_exchange/messages.h"
#include "parley_geometry/trajectory.h"

namespace parley {

/// What a packet should hold now. Records and observations ride with the rest.
struct Agenda {
  bool trajectory = false;
  bool intent = false;  // with a trajectory
  bool conflicts = false;
  bool beacon = false;
  bool full_beacon = false;  // with coverage, not only the state

  bool empty() const { return !trajectory && !conflicts && !beacon; }
};

/// Decides when beacons, trajectories and conflict messages are due.
class Pace {
 public:
  Pace(const ExchangeOptions& options, RobotId self) : options_(options), self_(self) {}

  void setTrajectory(const SampledTrajectory& trajectory) { trajectory_ = trajectory; }
  /// A change of right of way, or of the way by more than a little, makes the trajectory due again.
  void intentIs(const IntentMessage& intent);
  void setConflicts(const std::vector<Conflict>& conflicts);

  /// `beacon_rate` [Hz] as needed now.
  Agenda agenda(double now, double beacon_rate) const;
  /// What was sent of it.
  void sent(const Agenda& done, double now);

  const SampledTrajectory& trajectory() const { return trajectory_; }
  const std::vector<Conflict>& conflicts() const { return conflicts_; }

 private:
  bool trajectoryChanged(double now) const;
  bool intentChanged() const;
  double jitter() const;

  ExchangeOptions options_;
  RobotId self_;
  SampledTrajectory trajectory_, sent_trajectory_;
  IntentMessage intent_, sent_intent_;
  std::vector<Conflict> conflicts_;
  int conflict_sends_ = 0;         // [-] left to be sent soon
  int intent_sends_ = 0;           // [-] left with the next trajectories
  double intent_time_ = -1e9;      // [s] when it was last sent
  double trajectory_time_ = -1e9;  // [s] the same
  double conflict_time_ = -1e9;    // [s]
  double beacon_time_ = -1e9;      // [s]
  double full_time_ = -1e9;        // [s]
  std::uint32_t beacons_ = 0;
};

/// The part of a trajectory from now on, in steps that the wire has room for, relative to `now` [s].
TrajectoryMessage trajectoryMessage(const SampledTrajectory& trajectory, DriveState state, double now);

}  // namespace parley

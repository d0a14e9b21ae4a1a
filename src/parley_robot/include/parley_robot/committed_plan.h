// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "parley_geometry/status.h"
#include "parley_geometry/trajectory.h"
#include "parley_planner/planner.h"

namespace parley {

/// What the planner's answer means for a robot that has to report why it stands.
DriveState driveStateOf(PlanCode code);

/// The trajectory that is driven. A plan takes effect when its start time has come, not before; one that comes too late
/// is dropped and the committed one stands.
class CommittedPlan {
 public:
  /// `made_at`: time of the data it was made from; `start_time`: when it takes effect. [s]
  void offer(const PlanResult& result, double made_at, double start_time);

  /// Makes a pending plan the committed one if its time has come.
  void advance(double now);

  /// Nothing is committed or pending any more.
  void clear();

  const SampledTrajectory& trajectory() const { return trajectory_; }
  /// When the planner last replaced or confirmed it. [s]
  double stamp() const { return stamp_; }
  DriveState state() const { return state_; }
  const std::string& reason() const { return reason_; }
  /// Trajectories committed so far.
  int count() const { return count_; }

 private:
  struct Pending {
    PlanResult result;
    double made_at;
    double start_time;
  };

  std::optional<Pending> pending_;
  SampledTrajectory trajectory_;
  double stamp_ = -1e9;
  DriveState state_ = DriveState::kStopped;
  std::string reason_ = "no plan yet";
  int count_ = 0;
};

}  // namespace parley

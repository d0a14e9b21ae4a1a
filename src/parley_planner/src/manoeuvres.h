// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "drive_refinement.h"
#include "manoeuvre_task.h"
#include "parley_planner/planner_options.h"

namespace parley {

/// A way to get on: trajectory, the path it follows and how far it gets.
struct Proposal {
  SampledTrajectory trajectory;
  Path path;
  DriveEnd end = DriveEnd::kInfeasible;
  double advance = 0.0;     // [m] along the path
  double busy_until = 0.0;  // [s] until then the manoeuvre is not to be interrupted
};

/// The motions by which a robot gets onto a path and along it: drive on, turn on the spot first, back out of where it cannot
/// turn, or find its way among positions and headings.
class Manoeuvres {
 public:
  Manoeuvres(const PlannerOptions& options, const Footprint& footprint, const MotionLimits& limits);

  /// The simplest motion that gets somewhere, else the one that gets furthest, if any.
  std::optional<Proposal> propose(const ManoeuvreTask& task) const;
  /// From standing: a search with the exact footprint to a place further along the path.
  std::optional<Proposal> squeeze(const ManoeuvreTask& task) const;

 private:
  std::optional<Proposal> driveOn(const ManoeuvreTask& task, const TrajectoryPoint& start, bool reverse, const Path& path) const;
  Proposal stop(const ManoeuvreTask& task) const;
  std::optional<Proposal> turnAndDrive(const ManoeuvreTask& task) const;
  std::optional<Proposal> backOut(const ManoeuvreTask& task) const;
  std::size_t squeezeTarget(const Path& fine, const ManoeuvreTask& task) const;

  PlannerOptions options_;
  Footprint footprint_;
  DriveGenerator generator_;
  DriveRefinement refinement_;
};

constexpr double kSlowSpeed = 0.3;  // [m/s] slower than this a robot may try other manoeuvres than driving on
/// A drive that gets less far is worth looking for another. [m]
constexpr double kUsefulAdvance = 0.3;

/// It gets somewhere, or as far as was asked.
bool isUseful(const std::optional<Proposal>& proposal);

/// Slower than 2 cm/s and 0.02 rad/s.
bool stands(const Twist2& twist);

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "drive_generator.h"
#include "parley_planner/planner.h"
#include "sight_law.h"
#include "trajectory_validator.h"

namespace parley {

/// The steps of one plan and what is remembered between plans.
class Planner::Pipeline {
 public:
  Pipeline(const PlannerOptions& options, const Footprint& footprint, const MotionLimits& limits);

  PlanResult plan(const PlanRequest& request);
  void reset();

 private:
  /// A way to drive on: trajectory, the path it follows and how far it gets.
  struct Proposal {
    SampledTrajectory trajectory;
    ReferencePath path;
    DriveEnd end = DriveEnd::kInfeasible;
    double advance = 0.0;       // [m] along the path
    double busy_until = 0.0;    // [s] until then the manoeuvre is not to be interrupted
  };

  bool usable(const PlanRequest& request) const;
  TrajectoryPoint startState(const PlanRequest& request) const;
  bool arrived(const PlanRequest& request);
  Eigen::Vector2d localGoal(const PlanRequest& request) const;
  bool mayKeep(const PlanRequest& request) const;
  bool endsAtGoal(const PlanRequest& request) const;
  PlanResult replan(const PlanRequest& request, const TrajectoryPoint& start, bool committed_valid);
  std::optional<Proposal> propose(const Path& path, const TrajectoryPoint& start, const DriveScene& scene,
                                  const Margins& margins);
  std::optional<Proposal> driveOn(const Path& path, const TrajectoryPoint& start, bool reverse, const DriveScene& scene,
                                  const Margins& margins);
  std::optional<Proposal> turnAndDrive(const Path& path, const TrajectoryPoint& start, const DriveScene& scene,
                                       const Margins& margins);
  std::optional<Proposal> backOut(const Path& path, const TrajectoryPoint& start, const DriveScene& scene,
                                  const Margins& margins);
  PlanResult brake(const PlanRequest& request, const TrajectoryPoint& start, PlanCode code, const std::string& why);
  PlanResult keep(PlanCode code, const std::string& why) const;
  Margins margins() const;

  PlannerOptions options_;
  Footprint footprint_;
  MotionLimits limits_;
  DriveGenerator generator_;
  TrajectoryValidator validator_;
  SightLaw sight_law_;

  Surroundings surroundings_;
  Eigen::Vector2d goal_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d local_goal_ = Eigen::Vector2d::Zero();
  Path path_;                  // that the last commitment follows
  double planned_at_ = -1e9;   // [s]
  double busy_until_ = -1e9;   // [s]
  bool arrived_ = false;
};

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "manoeuvres.h"
#include "parley_planner/planner.h"
#include "progress_watch.h"
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
  /// A search for a way: how much room the path must have, and how far obstacles push it.
  struct Attempt {
    double least_clearance;   // [m]
    double comfort_distance;  // [m]
    double push_distance;     // [m]
    Margins margins;
    bool squeeze;
  };

  bool usable(const PlanRequest& request) const;
  TrajectoryPoint startState(const PlanRequest& request) const;
  bool arrived(const PlanRequest& request);
  bool mayKeep(const PlanRequest& request) const;
  bool endsAtGoal(const PlanRequest& request) const;
  void look(const PlanRequest& request, const TrajectoryPoint& start);
  bool heedsSight(const TrajectoryPoint& start) const;
  PlanResult replan(const PlanRequest& request, const TrajectoryPoint& start, bool committed_valid);
  std::optional<Proposal> bestProposal(const PlanRequest& request, const TrajectoryPoint& start);
  std::optional<Proposal> attempt(const Attempt& how, const PlanRequest& request, const TrajectoryPoint& start) const;
  PlanResult commit(const Proposal& proposal);
  PlanResult brake(const PlanRequest& request, const TrajectoryPoint& start, PlanCode code, const std::string& why);
  PlanResult keep(PlanCode code, const std::string& why) const;
  bool somethingMoved(const PlanRequest& request) const;

  PlannerOptions options_;
  Footprint footprint_;
  MotionLimits limits_;
  Manoeuvres manoeuvres_;
  TrajectoryValidator validator_;
  SightLaw sight_law_;
  ProgressWatch watch_;

  Surroundings surroundings_;
  Eigen::Vector2d goal_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d local_goal_ = Eigen::Vector2d::Zero();
  Path path_;                  // that the last commitment follows
  double speed_bound_ = 0.0;   // [m/s] by sight, where the robot is
  double planned_at_ = -1e9;   // [s]
  double busy_until_ = -1e9;   // [s]
  double squeezed_at_ = -1e9;  // [s]
  bool arrived_ = false;
};

}  // namespace parley

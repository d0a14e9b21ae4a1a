// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "manoeuvres.h"
#include "parley_planner/planner.h"
#include "progress_watch.h"
#include "sight_law.h"
#include "traffic.h"
#include "trajectory_validator.h"

namespace parley {

constexpr double kSqueezePeriod = 0.5;  // [s] the search for narrow places is the dearest step

/// The steps of one plan and what is remembered between plans.
class Planner::Pipeline {
 public:
  Pipeline(const PlannerOptions& options, const Footprint& footprint, const MotionLimits& limits);

  PlanResult plan(const PlanRequest& request);
  /// What the last plan took to make trajectories, by the computer's clock; negative where it made none. [s]
  double trajectoryTime() const { return trajectory_time_; }
  void reset();

 private:
  /// A search for a way: how much room the path must have, and how far obstacles push it.
  struct Attempt {
    double least_clearance;   // [m]
    double comfort_distance;  // [m]
    double push_distance;     // [m]
    Margins margins;
    bool squeeze;
    const Surroundings* shape = nullptr;     // with peers' room closed; null: as seen
    bool whole = false;                      // only a path to the local goal itself will do
    double most = 1e9;                       // [m] and no longer than this
    double trim = 0.0;                       // [m] of a path that does not reach the local goal, left out at its end
    std::vector<Blocked::Body> bodies = {};  // that stand, in `shape` too
  };

  bool usable(const PlanRequest& request) const;
  PlanResult planFrom(const PlanRequest& request);
  TrajectoryPoint measuredState(const PlanRequest& request) const;
  TrajectoryPoint startState(const PlanRequest& request) const;
  bool hasStrayed(const PlanRequest& request) const;
  bool arrived(const PlanRequest& request);
  bool mayKeep(const PlanRequest& request) const;
  bool endsAtGoal(const PlanRequest& request) const;
  void look(const PlanRequest& request, const TrajectoryPoint& start);
  /// What was committed may be faster than what has come into sight since allows.
  bool heedsSight(const TrajectoryPoint& start) const { return std::abs(start.twist.speed) < speed_bound_ + kSightSlack; }
  static constexpr double kSightSlack = 0.1;  // [m/s]
  PlanResult replan(const PlanRequest& request, const TrajectoryPoint& start, bool committed_valid);
  PlanResult decided(const PlanRequest& request, const TrajectoryPoint& start, const std::optional<Proposal>& proposal,
                     bool committed_valid);
  std::optional<Eigen::Vector2d> narrowPlaceAhead(const PlanRequest& request) const;
  Attempt usualAttempt() const;
  RightOfWay ownRight(const PlanRequest& request) const;
  bool isBehindPeer(const TrajectoryPoint& start) const;
  bool isNearPeers(const PlanRequest& request) const;
  bool isEngaged(const PlanRequest& request) const;
  Path expectedWay(const PlanRequest& request) const;
  Path desiredWay(const TrajectoryPoint& start) const;
  PlanResult rest(const PlanRequest& request, const TrajectoryPoint& start);
  PlanResult negotiate(const PlanRequest& request, const TrajectoryPoint& start, bool committed_valid);
  std::optional<Proposal> passBy(const TrafficDecision& decision, const Path& desired, const PlanRequest& request,
                                 const TrajectoryPoint& start);
  PlanResult makeRoom(const TrafficDecision& decision, const PlanRequest& request, const TrajectoryPoint& start);
  std::optional<PlanResult> makeWay(const PlanRequest& request, const TrajectoryPoint& start, const Eigen::Vector2d& back_to);
  std::optional<Proposal> escape(const TrafficDecision& decision, const PlanRequest& request, const TrajectoryPoint& start);
  std::optional<Proposal> escapeAlong(const Path& path, const PlanRequest& request, const TrajectoryPoint& start);
  std::optional<Proposal> squeezeAlong(const Path& path, const TrajectoryPoint& start);
  void findWayOut(const TrafficDecision& decision, const PlanRequest& request, const TrajectoryPoint& start);
  PlanResult leave(const PlanRequest& request, const TrajectoryPoint& start, bool committed_valid);
  std::optional<PlanResult> makeRoomForStranger(const PlanRequest& request, const TrajectoryPoint& start);
  void standOff(const PlanRequest& request, const TrajectoryPoint& start);
  void outwait(const PlanRequest& request, const TrajectoryPoint& start);
  void backOffFrom(const Eigen::Vector2d& other, const PlanRequest& request, const TrajectoryPoint& start);
  PlanResult standStill(const PlanRequest& request, const TrajectoryPoint& start, PlanCode code, const std::string& why);
  bool isTouched(const PlanRequest& request);
  void lookForRoom(const Eigen::Vector2d& here, double now);
  void tell(const RightOfWay& right, const Path& way);
  std::optional<Proposal> bestProposal(const PlanRequest& request, const TrajectoryPoint& start);
  Path routeToLocalGoal(const Eigen::Vector2d& here) const;
  FoundPath search(const Attempt& how, const TrajectoryPoint& start) const;
  std::optional<Proposal> along(const Path& path, const Attempt& how, const TrajectoryPoint& start);
  std::optional<Proposal> attempt(const Attempt& how, const TrajectoryPoint& start);
  PlanResult commit(const Proposal& proposal, PlanCode code = PlanCode::kDriving);
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
  Traffic traffic_;
  Intent intent_;
  std::optional<Eigen::Vector2d> escape_;                           // [m] the escape point on the way to which it is
  Path wished_escape_;                                              // [m] the way to the first escape point that was looked at
  std::optional<Eigen::Vector2d> room_;                             // [m] where it was when another could last have passed
  std::optional<Eigen::Vector2d> narrow_;                           // [m] where it was when another could last not have passed
  double furthest_ = 0.0;                                           // [m] it has been from its room since,
  double back_ = 0.0;                                               // [m] and the part of it that nobody pushed it
  std::vector<std::pair<double, Eigen::Vector2d>> failed_escapes_;  // [s] until when not to be tried, [m]
  std::optional<PeerTube> stranger_;                                // that it makes room for, unheard
  double stranger_until_ = -1e9;                                    // [s]
  double stranger_seen_ = -1e9;                                     // [s]
  double blocked_since_ = -1e9;                                     // [s] by something that moves and is not heard
  double blocked_last_ = -1e9;                                      // [s]
  double waited_since_ = -1e9;                                      // [s] for a teammate
  double waited_last_ = -1e9;                                       // [s]
  std::uint32_t stand_offs_ = 0;
  int stand_offs_in_row_ = 0;
  Eigen::Vector2d shut_in_at_ = Eigen::Vector2d::Zero();
  std::optional<Eigen::Vector2d> way_out_;  // [m] of where it is shut in
  double passing_off_until_ = -1e9;         // [s] passing by did not work
  int escapes_ = 0;
  bool meets_ = false;                  // its way met somebody's at the last plan
  bool reached_ = false;                // it has stood at this goal
  double rested_since_ = -1e9;          // [s]
  PlanCode code_ = PlanCode::kDriving;  // of what was committed last
  Eigen::Vector2d goal_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d local_goal_ = Eigen::Vector2d::Zero();
  Path desired_;                 // [m] where it would have gone at the last plan, if it were alone
  double desired_at_ = -1e9;     // [s]
  Route route_;                  // the last one there was
  double routed_at_ = -1e9;      // [s]
  Path path_;                    // that the last commitment follows
  SampledTrajectory committed_;  // as the plan found it
  double speed_bound_ = 0.0;     // [m/s] by sight, where the robot is
  double planned_at_ = -1e9;     // [s]
  double busy_until_ = -1e9;     // [s]
  double touched_until_ = -1e9;  // [s]
  double squeezed_at_ = -1e9;    // [s]
  bool arrived_ = false;
  double trajectory_time_ = -1.0;  // [s] of the computer's, for making trajectories
};

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "parley_geometry/footprint.h"
#include "parley_geometry/local_map.h"
#include "parley_geometry/motion.h"
#include "parley_geometry/route.h"
#include "parley_geometry/scan.h"
#include "parley_geometry/status.h"
#include "parley_geometry/tracked_object.h"
#include "parley_geometry/trajectory.h"
#include "parley_planner/peer_motion.h"
#include "parley_planner/planner_options.h"

namespace parley {

enum class PlanCode {
  kDriving,   // on the way
  kArrived,   // standing within the tolerance of the goal
  kNoRoute,   // the topological map has none: what is committed is driven to its end
  kNoPath,    // there is a route but no way onto it past what is seen
  kBlocked,   // something stands or moves in the way and there is no room to go round
  kWaiting,   // standing until another has passed
  kYielding,  // another goes first: keeping off its way
  kEscaping   // another goes first: on the way to where it does not need the room
};

/// All that a plan depends on. Positions are in the robot's odom frame.
struct PlanRequest {
  double now;         // [s] time of the inputs, robot's clock
  double start_time;  // [s] when the result will be used
  Odometry odometry;  // newest
  const LocalMap& map;
  const ObstacleScan& scan;  // newest, all bins: transient ones block now
  Pose2 T_odom_scan;         // of base_link at scan.stamp
  const std::vector<TrackedObject>& tracks;
  const Route& route;
  Eigen::Vector2d goal;                // [m]
  double goal_tolerance;               // [m]
  SampledTrajectory committed;         // what is being driven; may be empty
  std::uint32_t id = 0;                // [-] number of this robot, as teammates know it
  std::vector<PeerMotion> peers = {};  // teammates whose place is known
  bool team_known = false;             // all robots near are among the peers
  bool at_goal = false;                // it stands at its goal and would stay
};

struct PlanResult {
  Status<PlanCode> status;
  SampledTrajectory trajectory;                          // to commit from start_time on; ends standing; empty if keep_committed
  bool keep_committed = false;                           // what is being driven is still right
  Eigen::Vector2d local_goal = Eigen::Vector2d::Zero();  // [m]
  std::vector<Eigen::Vector2d> path;                     // [m] that the trajectory follows
  double speed_bound = 0.0;                              // [m/s] what sight allows at the start
  Intent intent;                                         // to be told to teammates
  std::optional<Eigen::Vector2d> escape = std::nullopt;  // [m] point on the way to which it makes room
  int escapes = 0;                                       // [-] escape points taken so far
  /// [m] The narrowest place of the route ahead, where it has found no way past what stands for a while.
  std::optional<Eigen::Vector2d> impassable = std::nullopt;
  double trajectory_time = -1.0;  // [s] of the computer's, for making trajectories; negative where none was made
};

/// Turns a route into a motion that ends in a stop inside space seen free: local goal, A*, smoothing, speed profile,
/// simulated tracking within the drive's limits, independent validation, and right of way among teammates (the paper's CRTP).
class Planner {
 public:
  /// Throws std::invalid_argument if options, footprint or limits are out of range.
  Planner(const PlannerOptions& options, const Footprint& footprint, const MotionLimits& limits);
  ~Planner();
  Planner(Planner&&) noexcept;
  Planner& operator=(Planner&&) noexcept;

  /// One plan, to be called at 10 Hz. Same calls, same results, bit for bit.
  PlanResult plan(const PlanRequest& request);

  /// Forgets the goal, the previous path and what could hide where.
  void reset();

 private:
  class Pipeline;
  std::unique_ptr<Pipeline> pipeline_;
};

}  // namespace parley

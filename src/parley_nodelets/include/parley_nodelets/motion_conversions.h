// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/Path.h>
#include <parley_msgs/PeerMotions.h>
#include <parley_msgs/Trajectory.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "parley_planner/planner.h"
#include "parley_robot/team_link.h"

namespace parley {

/// A plan with the times that belong to it.
struct TimedPlan {
  PlanResult result;        // path, local goal and speed bound do not travel
  double made_at = 0.0;     // [s] of the data it was made from
  double start_time = 0.0;  // [s] when it takes effect
};

/// What the planner has to know of the team.
struct TeamMotions {
  double stamp = 0.0;       // [s]
  std::uint32_t id = 0;     // [-] of this robot
  bool team_known = false;  // all robots near are among the peers
  std::vector<PeerMotion> peers;
};

/// From messages: nullopt if they are inconsistent (unknown constants, times that run back, sizes) or hold what is not finite.
std::optional<TimedPlan> fromMessage(const parley_msgs::Trajectory& message);
std::optional<TeamMotions> fromMessage(const parley_msgs::PeerMotions& message);

parley_msgs::Trajectory toMessage(const TimedPlan& plan, const std::string& odom_frame);
/// `names` are for people; a peer that has none there goes without.
parley_msgs::PeerMotions toMessage(const TeamMotions& motions, const std::map<RobotId, Teammate>& names,
                                   const std::string& odom_frame);
TeamMotions motionsOf(const TeamLink& team, double now);

/// A trajectory as RViz draws it.
nav_msgs::Path toPath(const SampledTrajectory& trajectory, double stamp, const std::string& odom_frame);

}  // namespace parley

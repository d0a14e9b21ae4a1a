// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "peer_tube.h"

namespace parley {

/// What a robot that has to leave its place knows.
struct EscapeTask {
  const Surroundings& surroundings;
  const Footprint& footprint;
  Pose2 start;
  Eigen::Vector2d goal;                 // [m] where it would go if it could
  const std::vector<PeerTube>& first;   // tubes to leave
  const std::vector<PeerTube>& others;  // of all peers: bodies to go round, unless they make room
  RightOfWay right;                     // with which this robot goes
  std::optional<Eigen::Vector2d> last;  // [m] the escape point it is on the way to
  std::vector<Eigen::Vector2d> failed;  // [m] those that did not work lately
  double room = 0.0;                    // [m] least distance of the escape point from obstacles
};

/// The way to what can be reached furthest from a place [m], through those who will make room.
std::optional<Path> pathAwayFrom(const EscapeTask& task, const Eigen::Vector2d& place);

/// The way to an escape point (section on conflict resolution of the paper): a place to stand, out of the tubes of those who
/// go first, chosen by least way to it, progress and room; where there is none within sight, the way further back before
/// them. All that the robot can reach in seen space is looked at instead of samples of it: see docs/decisions.
/// nullopt if there is nowhere to go.
std::optional<Path> escapePath(const EscapeTask& task);

}  // namespace parley

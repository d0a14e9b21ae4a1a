// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "parley_planner/peer_motion.h"
#include "path_search.h"
#include "surroundings.h"

namespace parley {

/// The room that a peer will need: a strip along the way that it means to go.
struct PeerTube {
  std::uint32_t id = 0;
  RightOfWay right;
  Footprint footprint;
  Pose2 pose;            // of the peer now
  double speed = 0.0;    // [m/s] now
  Path way;              // [m] evenly spaced by kTubeStep, from where it is
  double margin = 0.0;   // [m] to keep from it
  bool standing = true;  // it stands and has committed to nothing else
  bool stuck = false;    // it means to go on, but has stood for a while: it may have to turn
};
constexpr double kTubeStep = 0.1;  // [m]

/// The tube of a peer at a time [s], from its intent if that still fits, else from its trajectory.
PeerTube tubeOf(const PeerMotion& peer, double now, double margin);

/// How a way and a tube meet.
struct Meeting {
  double enters = 0.0;       // [m] along the own way
  double leaves = 0.0;       // [m] the same
  double peer_enters = 0.0;  // [m] along the tube
  bool against = false;      // somewhere they run against each other or cross
  bool head_on = false;      // they run against each other for longer than a robot
};

/// Where a way (evenly spaced by kTubeStep) comes nearer to the tube's middle than `distance` [m], first time; nullopt if
/// nowhere.
std::optional<Meeting> meetingOf(const Path& way, const PeerTube& tube, double distance);

/// Distance of a point from the tube's middle, and how far along it that is.
struct TubePlace {
  double distance = 1e3;                                // [m]
  double along = 0.0;                                   // [m]
  Eigen::Vector2d direction = Eigen::Vector2d::Zero();  // [-] of the tube there; zero if it is only a place
};
TubePlace placeIn(const PeerTube& tube, const Eigen::Vector2d& p);

/// The tube's middle, moved to the peer's right as far as there is room and as is needed for `way` to pass it at `separation`
/// [m] if both give half.
Path keepingRight(const PeerTube& tube, const Path& way, double separation, const DistanceField& obstacles);

/// The part of a polyline from the place nearest to `p` on, beginning at `p`; evenly spaced by kTubeStep, `reach` [m] at most.
Path wayFrom(const Path& way, const Eigen::Vector2d& p, double reach);

}  // namespace parley

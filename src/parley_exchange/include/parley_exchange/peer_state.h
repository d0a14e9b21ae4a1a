// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "parley_exchange/messages.h"
#include "parley_geometry/trajectory.h"

namespace parley {

/// What is known of another robot. Times are of this robot's clock, poses in the peer's odom frame.
struct PeerState {
  RobotId id = 0;
  std::string name;  // empty until a beacon came
  std::uint32_t boot = 0;
  double first_heard = 0.0;  // [s]
  double last_heard = 0.0;   // [s]
  bool neighbour = false;    // heard lately
  bool proven = false;       // it told of a packet sent from here lately: no recording of earlier runs
  bool duplicate = false;    // somebody else seems to use its name

  Odometry odometry;  // the last beacon's; stamp 0 before one came
  Footprint footprint;
  MotionLimits limits;
  DriveState state = DriveState::kStopped;

  bool clock_known = false;
  double clock_error = 0.0;  // [s] bound of what the stamps given here are off
  double heard = 0.0;        // [-] share of its packets that arrive here
  double heard_there = 0.0;  // [-] share of the packets from here that arrive there, as it says
};

/// A peer's committed trajectory in its odom frame, with times of this robot's clock.
struct PeerTrajectory {
  double received = 0.0;  // [s]
  DriveState state = DriveState::kStopped;
  SampledTrajectory trajectory;
};

/// Where a peer means to go, in its odom frame.
struct PeerIntent {
  double received = 0.0;  // [s]
  IntentMessage intent;
};

/// What a peer says about who goes first; the lease counts down from `received`.
struct PeerConflicts {
  double received = 0.0;  // [s]
  std::vector<Conflict> conflicts;
};

/// Blobs that a scan of a peer saw, with its pose then.
struct PeerObservations {
  double stamp = 0.0;     // [s] of the scan
  double received = 0.0;  // [s]
  Pose2 pose;             // T_odom_base of the peer
  std::vector<Observation> blobs;
};

/// Names one version of a contour of any robot.
struct ContourName {
  RobotId origin = 0;
  std::uint32_t id = 0;        // [-]
  std::uint32_t sequence = 0;  // [-]
};
inline bool operator==(const ContourName& a, const ContourName& b) {
  return a.origin == b.origin && a.id == b.id && a.sequence == b.sequence;
}

/// A contour as its origin tells it; place it by the anchor's pose.
struct SharedContour {
  ContourName name;
  std::uint32_t anchor = 0;  // [-]
  Polygon polygon;           // [m] in the anchor's frame
  bool closed = false;
  bool hole = false;
  int hops = 0;            // [-] robots it went through
  double written = 0.0;    // [s]
  double confirmed = 0.0;  // [s] when it was written or last endorsed
  int endorsements = 0;    // [-] robots that see it too
  bool contested = false;  // somebody saw through this version: it does not count
};

/// A place on a peer's track.
struct SharedAnchor {
  std::uint32_t id = 0;         // [-]
  Pose2 pose;                   // T_odom_anchor, odom frame of its origin
  double position_sigma = 0.0;  // [m] relative to the anchor before
  double yaw_sigma = 0.0;       // [rad]
  double written = 0.0;         // [s]
};

/// What some robot, this one included, believes about two others' anchors.
struct SharedEdge {
  RobotId origin = 0;
  EdgeBody edge;
  int hops = 0;          // [-]
  double written = 0.0;  // [s]
};

/// A scan of a peer to be recognised.
struct SharedKeyframe {
  std::uint32_t id = 0;  // [-]
  double stamp = 0.0;    // [s]
  Pose2 pose;            // T_odom_base of the peer
  Bytes descriptor;
};

}  // namespace parley

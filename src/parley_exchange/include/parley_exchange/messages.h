// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "parley_exchange/records.h"
#include "parley_geometry/footprint.h"
#include "parley_geometry/motion.h"
#include "parley_geometry/status.h"

namespace parley {

/// What a robot says of itself; the latest wins.
struct Beacon {
  std::string name;  // 1 to 24 printable characters
  double age = 0.0;  // [s] of pose and twist when the packet was sent
  Pose2 pose;        // T_odom_base of the sender
  Twist2 twist;      // of base_link in itself
  Footprint footprint;
  MotionLimits limits;
  DriveState state = DriveState::kStopped;
  int neighbours = 0;          // [-] robots it hears, 127 stands for more
  std::uint32_t map_hash = 0;  // [-] of its coverage of all maps; equal hashes, equal maps
};

/// What the sender knows of another robot's packets, for that robot: the other half of a time stamp exchange.
struct Echo {
  RobotId robot = 0;             // whom it is for
  std::uint16_t counter = 0;     // [-] of the last packet heard from it, modulo 2^16
  std::uint32_t difference = 0;  // [ticks] least (arrival, sender's clock - stamp, that robot's clock), modulo 2^32
  double heard = 0.0;            // [-] share of that robot's packets that arrived
};

/// Sequence numbers, both ends included.
struct Interval {
  std::uint32_t first = 1;  // [-]
  std::uint32_t last = 0;   // [-]
};
inline bool operator==(const Interval& a, const Interval& b) { return a.first == b.first && a.last == b.last; }

/// Which records of one log the sender has. Complete up to the end of the last interval; beyond it nothing is said.
struct DigestEntry {
  RobotId origin = 0;
  RecordStream stream = RecordStream::kMap;
  std::uint16_t epoch = 0;          // [-] lowest bits of the origin's boot
  std::vector<Interval> intervals;  // ascending, at most 5
};

/// The committed trajectory, which ends standing, in the sender's odom frame.
struct TrajectoryMessage {
  DriveState state = DriveState::kStopped;
  double start = 0.0;        // [s] time of the first pose after the packet's stamp, negative before
  double step = 0.25;        // [s] from pose to pose
  std::vector<Pose2> poses;  // 1 to 48
};

/// Where the sender means to go, and with whose right of way.
struct IntentMessage {
  double priority = 0.0;             // [-] the higher goes first
  RobotId holder = 0;                // whose right of way it is: the sender's own, or that of the robot it makes room for
  int depth = 0;                     // [-] 0: its own; else how many robots make room for another in between, itself included
  std::vector<Eigen::Vector2d> way;  // [m] 1 to 15 corners, the first where the sender is, in its odom frame
};

enum class ConflictKind { kClaim, kYield, kRelease };

/// One side of an agreement on who goes first. The lower (cost of yielding, then id) yields; a claim holds while its lease does.
struct Conflict {
  RobotId peer = 0;  // with whom
  ConflictKind kind = ConflictKind::kClaim;
  int round = 0;                         // [-] counts changes of mind, modulo 64
  double cost = 0.0;                     // [-] of yielding for the sender
  double lease = 0.0;                    // [s] left when the packet was sent
  std::optional<Eigen::Vector2d> place;  // [m] where the sender will wait, its odom frame
};

/// Something that could be a robot, as the sender's lidar sees it.
struct Observation {
  double range = 0.0;    // [m] from base_link
  double bearing = 0.0;  // [rad] in base_link
  double chord = 0.0;    // [m] width across the line of sight
};

/// What one scan saw.
struct ObservationMessage {
  double age = 0.0;  // [s] of the scan when the packet was sent
  Pose2 pose;        // T_odom_base at the scan
  std::vector<Observation> blobs;
};

/// Records of one log.
struct RecordGroup {
  RobotId origin = 0;
  std::uint32_t epoch = 0;  // [-] the origin's boot
  RecordStream stream = RecordStream::kMap;
  std::vector<Record> records;  // ascending sequence
};

/// All that one packet holds. A section that is missing says nothing.
struct PacketContent {
  std::uint32_t stamp = 0;  // [ticks] of the sender's clock at sending, modulo 2^32
  std::optional<Beacon> beacon;
  std::vector<Echo> echoes;
  std::vector<DigestEntry> digest;
  std::optional<TrajectoryMessage> trajectory;
  std::optional<IntentMessage> intent;
  std::optional<std::vector<Conflict>> conflicts;  // all that hold; an empty list releases all
  std::vector<ObservationMessage> observations;    // one a scan, the newest first
  std::vector<RecordGroup> records;
  int unknown_sections = 0;    // [-] of types that this version does not know
  int malformed_sections = 0;  // [-] that could not be read; left out
};

}  // namespace parley

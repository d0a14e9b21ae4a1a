// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "parley_exchange/bit_stream.h"
#include "parley_geometry/covariance.h"

namespace parley {

/// A robot on the radio: a hash of its name.
using RobotId = std::uint32_t;

/// Time on the air. [s]
constexpr double kTick = 1e-4;

/// Each robot writes two logs. Maps are passed on by everybody, keyframes only by their origin.
enum class RecordStream { kMap = 0, kKeyframes = 1 };

/// Kinds up to 15 fit the format; what a version does not know it stores and passes on all the same.
enum class RecordKind { kContour = 0, kAnchor = 1, kEdge = 2, kContest = 3, kEndorsement = 4, kKeyframe = 5 };
constexpr int kRecordKinds = 16;

/// One version of one entry of an origin's log. Only the origin writes it; on the way nothing but hops and age changes.
struct Record {
  RecordKind kind = RecordKind::kContour;
  std::uint32_t id = 0;        // [-] with the kind the name of the entry; below 2^16
  std::uint32_t sequence = 1;  // [-] one count for all of the log; the higher one of an entry wins
  std::uint32_t gap = 0;       // [-] so many sequence numbers before this one are known to be superseded
  bool removed = false;        // a tombstone: the entry is gone, the body is empty
  int hops = 0;                // [-] robots it went through, 7 stands for more
  double age = 0.0;            // [s] since the origin wrote it, to 12 %
  Bytes body;                  // at most 300 bytes
};

constexpr std::size_t kMaxBody = 300;        // [byte]
constexpr std::size_t kMaxVertices = 48;     // [-] of a contour
constexpr std::size_t kMaxDescriptor = 256;  // [byte] of a keyframe
constexpr double kVertexStep = 0.05;         // [m]
constexpr int kVertexLimit = 511;            // [-] vertices lie within +-511 steps of the anchor

/// A piece of an obstacle's outline in an anchor's frame, on the grid that the wire has.
struct ContourBody {
  std::uint32_t anchor = 0;               // [-] id
  bool closed = false;                    // the last vertex is joined to the first
  bool hole = false;                      // the obstacle is around it
  std::vector<Eigen::Vector2i> vertices;  // [kVertexStep]
};

/// A place of the origin's own track that others are tied to.
struct AnchorBody {
  Pose2 pose;                   // T_odom_anchor
  double position_sigma = 0.0;  // [m] relative to the anchor before
  double yaw_sigma = 0.0;       // [rad] the same
};

enum class EdgeState { kTentative, kConfirmed, kWithdrawn };

/// Where a robot believes an anchor of another robot to be, relative to one of its own.
struct EdgeBody {
  std::uint32_t anchor = 0;  // [-] the origin's
  RobotId peer = 0;
  std::uint16_t peer_epoch = 0;   // [-] lowest bits of the peer's boot
  std::uint32_t peer_anchor = 0;  // [-]
  PoseEstimate T_anchor_peer;     // to the peer's anchor
  int support = 0;                // [-] matches behind it, 63 stands for more
  EdgeState state = EdgeState::kTentative;
};

/// Body of contests and endorsements: one version of a contour of somebody else.
struct ContourReference {
  RobotId origin = 0;
  std::uint16_t epoch = 0;     // [-] lowest bits of the origin's boot
  std::uint32_t id = 0;        // [-]
  std::uint32_t sequence = 0;  // [-] later versions are not meant
};

/// A scan to be recognised, opaque here.
struct KeyframeBody {
  std::uint32_t stamp = 0;  // [ticks] of the origin's clock, modulo 2^32
  Pose2 pose;               // T_odom_base
  Bytes descriptor;
};

}  // namespace parley

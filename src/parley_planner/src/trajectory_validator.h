// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "margins.h"
#include "parley_geometry/footprint.h"
#include "parley_geometry/local_map.h"
#include "parley_geometry/scan.h"
#include "parley_geometry/status.h"
#include "parley_geometry/tracked_object.h"
#include "parley_geometry/trajectory.h"
#include "parley_planner/peer_motion.h"

namespace parley {

enum class Flaw {
  kNone,
  kEmpty,
  kNotFinite,
  kDiscontinuous,  // does not begin in the state it must
  kLimits,         // faster or more sudden than the drive
  kDoesNotStop,    // its last state moves
  kObstacle,       // comes too near to a return or an occupied cell
  kUnseen,         // enters space that has not been seen free
  kTrack,          // comes too near to where a moving thing will be
  kPeer            // comes too near to where a teammate said it will be
};

struct Verdict {
  Flaw flaw = Flaw::kNone;
  double time = 0.0;  // [s] of the first flawed state
  bool good() const { return flaw == Flaw::kNone; }
};

/// What is known of the surroundings when a trajectory is judged.
struct Evidence {
  const LocalMap& map;
  const ObstacleScan& scan;
  Pose2 T_odom_scan;
  const std::vector<TrackedObject>& tracks;
  std::vector<PeerMotion> peers = {};
  RightOfWay right = {};  // of this robot
};

/// Judges a trajectory by the exact rectangle against every return of the newest scan and every occupied cell. Shares no
/// code with what generates trajectories.
class TrajectoryValidator {
 public:
  TrajectoryValidator(const Footprint& footprint, const MotionLimits& limits, double prediction_time, double track_margin);

  /// Takes in new evidence, which must outlive the calls that follow.
  void observe(const Evidence& evidence);

  /// A trajectory about to be committed: all of it, from the state it must begin in.
  Verdict check(const SampledTrajectory& trajectory, const TrajectoryPoint& begin, const Margins& margins) const;
  /// What is left of a committed one from `time` [s] on: the surroundings only.
  Verdict checkRest(const SampledTrajectory& trajectory, double time, const Margins& margins) const;
  /// What stands alone, and what moves alone.
  Verdict checkObstacles(const std::vector<TrajectoryPoint>& points, const Margins& margins) const;
  Verdict checkTracks(const std::vector<TrajectoryPoint>& points) const;
  /// Teammates alone. Those that this robot goes before count until `trust_from` [s]: by then they have made room.
  Verdict checkPeers(const std::vector<TrajectoryPoint>& points, double trust_from = 1e18) const;

 private:
  Verdict checkMotion(const std::vector<TrajectoryPoint>& points, const TrajectoryPoint& begin) const;
  /// Peers that this robot goes before count until `trust_from` [s]: by then they have made room.
  Verdict checkPlaces(const std::vector<TrajectoryPoint>& points, const Margins& margins, double trust_from) const;
  double peerDistance(const TrajectoryPoint& point, double trust_from) const;
  Verdict checkUnseen(const std::vector<TrajectoryPoint>& points) const;
  void addPoint(const Eigen::Vector2d& p_odom);
  double obstacleDistance(const Pose2& pose) const;
  double trackDistance(const TrajectoryPoint& point) const;
  int unseenCells(const Pose2& pose) const;
  bool seenThrough(const Eigen::Vector2d& p_odom) const;

  Footprint footprint_;
  MotionLimits limits_;
  double prediction_time_;
  double track_margin_;

  const LocalMap* map_ = nullptr;
  const ObstacleScan* scan_ = nullptr;
  const std::vector<TrackedObject>* tracks_ = nullptr;
  std::vector<PeerMotion> peers_;
  RightOfWay right_;
  Pose2 T_scan_odom_;
  GridFrame buckets_frame_;
  std::vector<std::vector<Eigen::Vector2d>> buckets_;  // [m] obstacle points by place, odom frame
};

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "margins.h"
#include "parley_geometry/motion.h"
#include "parley_planner/peer_motion.h"
#include "path_follower.h"
#include "surroundings.h"

namespace parley {

/// Why a drive ends where it does.
enum class DriveEnd { kPathEnd, kObstacle, kUnseen, kTrack, kPeer, kInfeasible };

struct GeneratedDrive {
  PathDrive drive;
  DriveEnd end = DriveEnd::kInfeasible;
  double advance = 0.0;  // [m] along the path
};

/// What a drive must keep clear of.
struct DriveScene {
  const Surroundings& surroundings;
  const std::vector<TrackedObject>& tracks;
  double prediction_time;  // [s]
  double track_margin;     // [m]
  std::vector<PeerMotion> peers;
  double peer_margin;  // [m] their pose's error apart
};

/// Between a robot and a peer when the robot is there, to what has to be kept between them; not more than 1. [m]
double peerClearance(const Footprint& footprint, const TrajectoryPoint& point, const PeerMotion& peer, double margin);

/// Finds the fastest simulated drive along a path that keeps its margins and ends standing in space seen free: simulates,
/// lowers the speed profile where the drive came too near, and repeats.
class DriveGenerator {
 public:
  DriveGenerator(const Footprint& footprint, const MotionLimits& limits, double time_step);

  const MotionLimits& limits() const { return limits_; }
  /// `sight_bounds`: [m/s] for each of the path's points, or empty.
  GeneratedDrive along(const ReferencePath& path, const TrajectoryPoint& start, bool reverse, const DriveScene& scene,
                       const Margins& margins, const std::vector<double>& sight_bounds) const;

  /// Turning on the spot to `yaw`, by the shorter way; empty if there is no room.
  std::vector<TrajectoryPoint> turn(const TrajectoryPoint& start, double yaw, const DriveScene& scene,
                                    const Margins& margins) const;

  const FootprintProbe& probe() const { return probe_; }

 private:
  /// What the drive's start already lacks is not asked of what follows.
  struct Floor {
    double obstacles;  // [m]
    double unseen;     // [m]
    double tracks;     // [m]
    double peers;      // [m]
  };
  struct Correction {
    SpeedProfile profile;
    DriveEnd end;  // why the profile stops where it does
    bool changed;
  };
  Floor floorAt(const TrajectoryPoint& start, const DriveScene& scene, const Margins& margins) const;
  /// The profile under which the next simulation should keep clear of what this one came too near to.
  Correction corrected(const PathDrive& drive, const SpeedProfile& profile, const DriveScene& scene, const Margins& margins,
                       const Floor& floor) const;
  SpeedProfile profileAlong(const ReferencePath& path, const DriveScene& scene, const Margins& margins,
                            const std::vector<double>& sight_bounds) const;
  bool isFree(const std::vector<TrajectoryPoint>& points, const DriveScene& scene, const Margins& margins) const;
  double peersClearance(const TrajectoryPoint& point, const DriveScene& scene) const;
  double trackClearance(const TrajectoryPoint& point, const DriveScene& scene, double start_time) const;

  Footprint footprint_;
  FootprintProbe probe_;
  MotionLimits limits_;
  double time_step_;
};

}  // namespace parley

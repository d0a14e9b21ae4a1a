// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "parley_geometry/scan.h"
#include "parley_geometry/tracked_object.h"
#include "parley_planner/planner.h"
#include "peer_tube.h"

namespace parley {

/// Who goes first where ways meet, as this robot sees it now.
struct TrafficDecision {
  RightOfWay right;                // this robot's
  std::vector<PeerTube> first;     // that go before it and need room on its way, or where it stands
  std::vector<PeerTube> opposite;  // that come towards it, whoever goes first
  bool in_the_way = false;         // it stands in the tube of one of the first
};

/// Teammates whose motion is known, and what follows from it. Rules of right of way: all that meet order themselves alike by
/// goesBefore(), a robot that comes late to a crossing where nobody is yet may pass before one that goes first, and who
/// drives the same way does not make room.
class Traffic {
 public:
  Traffic(const PlannerOptions& options, const Footprint& footprint);

  void reset();

  /// Takes in whom to believe: peers that lately told of their motion and that the lidar does not contradict.
  void observe(const PlanRequest& request);

  /// Peers whose told motion is believed; what the lidar sees of them is no obstacle of its own.
  const std::vector<PeerMotion>& peers() const { return peers_; }
  /// The same, and each once more as if it braked soon: robots change their plans.
  const std::vector<PeerMotion>& careful() const { return careful_; }
  const ObstacleScan& scan() const { return scan_; }
  const std::vector<TrackedObject>& tracks() const { return tracks_; }
  const std::vector<PeerTube>& tubes() const { return tubes_; }

  /// Peers that come against a way [m] or mean to, as things that move: until both have heard of each other's newest plans,
  /// either may drive on into what is free between them.
  std::vector<TrackedObject> oncoming(const Path& way, double now) const;

  /// There is nowhere to make room. Having said so for a while without a break, it is shut in: then others have to make room
  /// for it, until it has come out. Returns whether it is so now.
  bool cannotMakeRoom(double now, const Eigen::Vector2d& here);
  bool isShutIn(double now) const { return now < shut_in_until_; }
  /// Where the robot is by now, and whether another could pass it there.
  void getsOn(double now, const Eigen::Vector2d& here, bool has_room);
  void isOutAgain() { shut_in_until_ = -1e9; }

  /// `way`: where this robot would go if it were alone, from where it is. `own`: its right of way when nobody pushes it.
  TrafficDecision decide(const Path& way, const RightOfWay& own, const TrajectoryPoint& state, double now);

 private:
  void noteStanding(double now);
  void boundLentRights();
  bool isIn(const PeerTube& tube, const Pose2& pose) const;
  bool contradicted(const PeerMotion& peer, const PlanRequest& request) const;
  void withoutPeers(const PlanRequest& request);
  RightOfWay rightNow(const RightOfWay& own, double now) const;

  PlannerOptions options_;
  Footprint footprint_;
  std::vector<PeerMotion> peers_;
  std::vector<PeerTube> tubes_;
  std::vector<PeerMotion> careful_;
  std::map<std::uint32_t, double> standing_since_;  // [s] by peer
  ObstacleScan scan_;
  std::vector<TrackedObject> tracks_;
  RightOfWay lent_;              // of the robot that this one makes room for
  double lent_until_ = -1e9;     // [s]
  double no_room_since_ = -1e9;  // [s]
  double no_room_last_ = -1e9;   // [s]
  double shut_in_until_ = -1e9;  // [s]
  Eigen::Vector2d shut_in_at_ = Eigen::Vector2d::Zero();
  double came_out_ = 0.0;  // [m] from there
};

}  // namespace parley

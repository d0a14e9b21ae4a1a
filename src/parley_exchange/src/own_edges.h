// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>

#include "own_log.h"
#include "parley_exchange/exchange.h"

namespace parley {

/// This robot's own measurements of where others are, told as edges between anchors.
class OwnEdges {
 public:
  /// At most `count` edges at a time; a new one takes the place of one that was not measured for a while.
  OwnEdges(OwnLog log, double interval, int count) : log_(log), interval_(interval), count_(static_cast<std::size_t>(count)) {}

  /// An estimate in odom frames, tied to the anchors given with their poses. Told again when its state changes, or at
  /// intervals where it moved or got clearly better.
  void publish(RobotId peer, std::uint32_t peer_epoch, const PeerPose& estimate, const SharedAnchor& own,
               const SharedAnchor& theirs, double now);

 private:
  struct Told {
    std::uint32_t id = 0;  // [-] of the record
    EdgeBody edge;
    PoseEstimate T_odom_peer;
    double time = 0.0;      // [s] when it was told
    double measured = 0.0;  // [s] when it was last measured
  };
  bool isWorthTelling(const Told& told, std::uint16_t peer_epoch, const PeerPose& estimate, double now) const;

  /// The record id for a peer that has none yet; nullopt if there is no room.
  std::optional<std::uint32_t> makeRoom(double now);

  OwnLog log_;
  double interval_;  // [s]
  std::size_t count_;
  std::map<RobotId, Told> told_;
};

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>

#include "own_log.h"
#include "parley_exchange/exchange.h"

namespace parley {

/// This robot's own measurements of where others are, told as edges between anchors.
class OwnEdges {
 public:
  OwnEdges(OwnLog log, double interval) : log_(log), interval_(interval) {}

  /// An estimate in odom frames, tied to the anchors given with their poses. Told again when its state changes, or at
  /// intervals where it moved or got clearly better.
  void publish(RobotId peer, std::uint32_t peer_epoch, const PeerPose& estimate, const SharedAnchor& own,
               const SharedAnchor& theirs, double now);

 private:
  struct Told {
    std::uint32_t id = 0;  // [-] of the record
    EdgeBody edge;
    PoseEstimate T_odom_peer;
    double time = 0.0;  // [s]
  };
  bool isWorthTelling(const Told& told, std::uint16_t peer_epoch, const PeerPose& estimate, double now) const;

  OwnLog log_;
  double interval_;  // [s]
  std::map<RobotId, Told> told_;
};

}  // namespace parley

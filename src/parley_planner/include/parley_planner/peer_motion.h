// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <tuple>
#include <vector>

#include "parley_geometry/footprint.h"
#include "parley_geometry/trajectory.h"

namespace parley {

/// By what a robot goes before another. All robots order any two of these alike, so that of two exactly one makes room, and
/// among many one goes before all. A robot that has to leave its place for another does so with that one's right of way:
/// who stands behind it makes room in turn (priority inheritance).
struct RightOfWay {
  double priority = 0.0;     // [-] 0: has arrived, 1 to 5: is on its way, 10: is shut in
  std::uint32_t holder = 0;  // number of the robot whose right of way it is
  int depth = 0;             // [-] 0: its own; one more for each robot that makes room for another in between
};
inline bool goesBefore(const RightOfWay& a, const RightOfWay& b) {
  return std::make_tuple(a.priority, a.holder, -a.depth) > std::make_tuple(b.priority, b.holder, -b.depth);
}

/// Where a robot means to go.
struct Intent {
  RightOfWay right;
  std::vector<Eigen::Vector2d> way;  // [m] corners from where it is; odom frame of whoever holds this
};

/// A teammate as it drives, as far as it said; in the odom frame of the robot that plans, times of its clock.
struct PeerMotion {
  std::uint32_t id = 0;
  Footprint footprint;
  SampledTrajectory trajectory;  // what it has committed, ends standing; not empty
  double heard = 0.0;            // [s] when it said so
  double sigma = 0.0;            // [m] standard deviation of its place here
  Intent intent;                 // way empty: it has not said
};

/// By how much a peer may be elsewhere than where it is believed: two standard deviations, 0.15 at most. [m]
inline double uncertaintyOf(const PeerMotion& peer) { return std::min(0.15, 2.0 * peer.sigma); }

}  // namespace parley

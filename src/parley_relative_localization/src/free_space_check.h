// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "submap.h"

namespace parley {

/// What the scans of two robots say of each other's points, both ways.
struct FreeSpaceVote {
  int points = 0;      // [-] that were asked about
  int matches = 0;     // [-] on the other's surface
  int violations = 0;  // [-] the other looked through them

  int votes() const { return matches + violations; }
  double violationShare() const { return votes() > 0 ? static_cast<double>(violations) / votes() : 0.0; }
  /// Matches minus four times the violations. [-]
  int score() const { return matches - 4 * violations; }
};

/// `T_a_b`: odom of b in odom of a. At most `count` points of each side are asked about. Points within 0.7 m of where either
/// robot was when it took a scan are left out: they may be the robot.
FreeSpaceVote voteOnFreeSpace(const Submap& a, const Submap& b, const Pose2& T_a_b, std::size_t count = 240);

}  // namespace parley

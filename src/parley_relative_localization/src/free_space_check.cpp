// SPDX-License-Identifier: BSD-3-Clause
#include "free_space_check.h"

#include <algorithm>

namespace parley {
namespace {

constexpr double kBody = 0.7;    // [m] a robot is no larger than this
constexpr double kMargin = 0.1;  // [m] room for the pose's error on top of what sightOf allows

bool isNearAScan(const std::vector<PlacedScan>& scans, const Eigen::Vector2d& p) {
  return std::any_of(scans.begin(), scans.end(),
                     [&](const PlacedScan& placed) { return (placed.T_odom_scan.position() - p).squaredNorm() < kBody * kBody; });
}

/// Asks the scans of `judge` about points of `other`.
void vote(const Submap& judge, const Submap& other, const Pose2& T_judge_other, std::size_t count, FreeSpaceVote& result) {
  for (const SurfacePoint& point : other.sample(count)) {
    const Eigen::Vector2d p = T_judge_other * point.position;
    if (isNearAScan(judge.scans(), p)) continue;
    ++result.points;
    bool seen_through = false, matched = false;
    for (std::size_t i = 0; i < judge.scans().size(); ++i) {
      const Sighting sight = judge.sight(i, p, kMargin);
      matched = matched || sight == Sighting::kMatch;
      seen_through = seen_through || sight == Sighting::kSeenThrough;
      if (matched) break;
    }
    result.matches += matched ? 1 : 0;
    result.violations += seen_through && !matched ? 1 : 0;
  }
}

}  // namespace

FreeSpaceVote voteOnFreeSpace(const Submap& a, const Submap& b, const Pose2& T_a_b, std::size_t count) {
  FreeSpaceVote result;
  vote(a, b, T_a_b, count, result);
  vote(b, a, T_a_b.inverse(), count, result);
  return result;
}

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#include "surface_check.h"

#include <utility>

namespace parley {
namespace {

constexpr std::size_t kSample = 300;    // [-] points of one side that are matched
constexpr double kIndexCell = 0.4;      // [m]
constexpr double kFarthest = 0.3;       // [m] the refined pose is no farther away
constexpr double kFarthestTurn = 0.12;  // [rad]
constexpr int kFewestVotes = 30;        // [-] fewer contradict nothing
constexpr double kContradiction = 4.0;  // [-] times the share of violations that still agrees

std::vector<SurfacePoint> lined(const Submap& submap) { return submap.sample(submap.points().size()); }

}  // namespace

SurfaceMap::SurfaceMap(std::vector<PlacedScan> scans)
    : submap(std::move(scans)), index(lined(submap), kIndexCell), sample(submap.sample(kSample)) {}

SurfaceVerdict checkSurfaces(const SurfaceMap& own, const SurfaceMap& peer, const PoseInformation& pose,
                             const RelativeLocalizationOptions& options) {
  SurfaceVerdict verdict;
  verdict.estimate = pose;
  if (own.sample.empty() || peer.sample.empty()) return verdict;
  verdict.asked = true;
  const ScanMatch match = refineMatch(own.index, peer.sample, pose);
  const Pose2 refined = match.converged ? match.estimate.pose : pose.pose;
  verdict.vote = voteOnFreeSpace(own.submap, peer.submap, refined);
  const FreeSpaceVote& vote = verdict.vote;
  verdict.contradicts = vote.votes() >= kFewestVotes && vote.violationShare() > kContradiction * options.max_violations;
  const Eigen::Vector3d step = stepBetween(pose.pose, refined, pose.center);
  verdict.agrees = match.converged && vote.matches >= options.matches_mutual && vote.violationShare() <= options.max_violations &&
                   step.head<2>().norm() < kFarthest && std::abs(step.z()) < kFarthestTurn;
  verdict.objects = !verdict.agrees && vote.votes() >= kFewestVotes;
  if (!verdict.agrees) return verdict;
  verdict.observed = match.observability.share >= options.min_observability;
  verdict.estimate = match.estimate;
  if (!verdict.observed) {
    verdict.estimate.information = withoutDirection(match.estimate.information, match.observability.weakest);
  }
  return verdict;
}

}  // namespace parley

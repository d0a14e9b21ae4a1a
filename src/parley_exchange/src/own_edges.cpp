// SPDX-License-Identifier: BSD-3-Clause
#include "own_edges.h"

#include <algorithm>
#include <cmath>

#include "body_codec.h"
#include "knowledge.h"

namespace parley {
namespace {

constexpr double kMoved = 0.05;   // [m]
constexpr double kTurned = 0.01;  // [rad]
constexpr double kOld = 10.0;     // [s] not measured for so long, an edge may make room
constexpr double kBetter = 0.7;   // [-] ratio of variances that counts as an improvement

PoseEstimate exact(const Pose2& pose) { return {pose, Covariance3::Zero()}; }

}  // namespace

bool OwnEdges::isWorthTelling(const Told& told, std::uint16_t peer_epoch, const PeerPose& estimate, double now) const {
  if (told.edge.state != estimate.state || told.edge.peer_epoch != peer_epoch) return true;
  if (now - told.time < interval_) return false;
  const Pose2 change = told.T_odom_peer.pose.inverse() * estimate.T_odom_peer.pose;
  return change.position().norm() > kMoved || std::abs(change.yaw) > kTurned ||
         estimate.T_odom_peer.covariance.trace() < kBetter * told.T_odom_peer.covariance.trace();
}

std::optional<std::uint32_t> OwnEdges::makeRoom(double now) {
  if (told_.size() < count_) return log_.freeId(RecordKind::kEdge);
  const auto oldest = std::min_element(told_.begin(), told_.end(),
                                       [](const auto& a, const auto& b) { return a.second.measured < b.second.measured; });
  if (now - oldest->second.measured < kOld) return std::nullopt;
  const std::uint32_t id = oldest->second.id;
  told_.erase(oldest);
  return id;
}

void OwnEdges::publish(RobotId peer, std::uint32_t peer_epoch, const PeerPose& estimate, const SharedAnchor& own,
                       const SharedAnchor& theirs, double now) {
  const auto before = told_.find(peer);
  if (before != told_.end()) before->second.measured = now;
  if (before != told_.end() && !isWorthTelling(before->second, shortEpoch(peer_epoch), estimate, now)) return;
  if (before == told_.end() && estimate.state == EdgeState::kWithdrawn) return;
  const std::optional<std::uint32_t> id = before != told_.end() ? before->second.id : makeRoom(now);
  if (!id) return;
  Told told;
  told.id = *id;
  told.T_odom_peer = estimate.T_odom_peer;
  told.time = told.measured = now;
  told.edge.anchor = own.id;
  told.edge.peer = peer;
  told.edge.peer_epoch = shortEpoch(peer_epoch);
  told.edge.peer_anchor = theirs.id;
  told.edge.T_anchor_peer = compose(compose(exact(own.pose.inverse()), estimate.T_odom_peer), exact(theirs.pose));
  told.edge.support = estimate.support;
  told.edge.state = estimate.state;
  if (log_.write(RecordKind::kEdge, told.id, encode(told.edge), now)) told_[peer] = told;
}

}  // namespace parley

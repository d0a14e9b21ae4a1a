// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "pipeline.h"

namespace parley {

namespace {

constexpr double kBlockedBreak = 1.0;   // [s]
constexpr double kLeastPatience = 2.0;  // [s] a robot waits for a stranger to go away,
constexpr double kMorePatience = 5.0;   // [s] or up to so much longer
constexpr double kLongWait = 8.0;       // [s] at least, for a teammate that stands
constexpr double kStrangerNear = 8.0;   // [m] who is further off does not come
constexpr double kStrangerGone = 5.0;   // [s] not seen for so long, it does not come
constexpr double kStandOffReach = 2.0;  // [m] who is further off does not block
constexpr double kSameStandOff = 20.0;  // [s] after one, the next is another try at the same
constexpr int kMostDoublings = 3;       // [-] of the time for which room is made
constexpr double kStrangerReach = 5.0;  // [m] behind this robot

/// In [0, 1), another one for each robot and each time.
double shareOf(std::uint32_t id, std::uint32_t time) {
  std::uint32_t hash = (id ^ (time * 2654435761U)) * 2246822519U;
  hash = (hash ^ (hash >> 15)) * 3266489917U;
  return static_cast<double>(hash >> 16) / 65536.0;
}

}  // namespace

std::optional<PlanResult> Planner::Pipeline::makeRoomForStranger(const PlanRequest& request, const TrajectoryPoint& start) {
  const Eigen::Vector2d here = start.pose.position();
  const bool is_there = std::any_of(traffic_.tracks().begin(), traffic_.tracks().end(), [&](const TrackedObject& track) {
    return track.has_moved && (track.position - here).norm() < kStrangerNear;
  });
  if (is_there) stranger_seen_ = request.now;
  if (request.now - stranger_seen_ > kStrangerGone) stranger_.reset();
  if (!stranger_ || request.now >= stranger_until_) return std::nullopt;
  const TrafficDecision decision{ownRight(request), {*stranger_}, {}, true};
  tell(decision.right, {start.pose.position()});
  return makeRoom(decision, request, start);
}

/// Blocked by somebody who is not heard. Nothing can be agreed: after a while of its own choice, different for each robot and
/// each time, it makes room as if the other wanted to pass right through it, for a while of its own choice, each time longer.
void Planner::Pipeline::standOff(const PlanRequest& request, const TrajectoryPoint& start) {
  if (!somethingMoved(request)) return;
  if (request.now - blocked_last_ > kBlockedBreak) blocked_since_ = request.now;
  blocked_last_ = request.now;
  const double patience = kLeastPatience + kMorePatience * shareOf(request.id, stand_offs_);
  if (request.now - blocked_since_ < patience) return;
  const Eigen::Vector2d here = start.pose.position();
  const auto nearest =
      std::min_element(traffic_.tracks().begin(), traffic_.tracks().end(), [&](const TrackedObject& a, const TrackedObject& b) {
        return std::make_pair(!a.has_moved, (a.position - here).norm()) <
               std::make_pair(!b.has_moved, (b.position - here).norm());
      });
  if (nearest == traffic_.tracks().end() || !nearest->has_moved) return;
  if ((nearest->position - here).norm() > kStandOffReach + nearest->radius) return;
  blocked_since_ = request.now;
  backOffFrom(nearest->position, request, start);
}

/// Waiting for a teammate that stands and sees no reason to make room: by its own estimate of where the two are, it is not in
/// the way. After a while this robot makes room as if the other came, and tries again from elsewhere.
void Planner::Pipeline::outwait(const PlanRequest& request, const TrajectoryPoint& start) {
  if (request.now - waited_last_ > kBlockedBreak) waited_since_ = request.now;
  waited_last_ = request.now;
  if (request.now - waited_since_ < kLongWait + kMorePatience * shareOf(request.id, stand_offs_)) return;
  waited_since_ = request.now;
  const Eigen::Vector2d here = start.pose.position();
  const PeerTube* nearest = nullptr;
  for (const PeerTube& tube : traffic_.tubes()) {
    if (!tube.standing) continue;
    const bool is_nearer = nearest == nullptr || (tube.pose.position() - here).norm() < (nearest->pose.position() - here).norm();
    if (is_nearer) nearest = &tube;
  }
  if (nearest == nullptr || (nearest->pose.position() - here).norm() > kStandOffReach) return;
  stranger_seen_ = request.now;
  backOffFrom(nearest->pose.position(), request, start);
}

void Planner::Pipeline::backOffFrom(const Eigen::Vector2d& other, const PlanRequest& request, const TrajectoryPoint& start) {
  const Eigen::Vector2d here = start.pose.position();
  ++stand_offs_;
  stand_offs_in_row_ = request.now - stranger_until_ < kSameStandOff ? stand_offs_in_row_ + 1 : 0;
  const double longer = std::exp2(std::min(kMostDoublings, stand_offs_in_row_));
  stranger_until_ = request.now + longer * (kLeastPatience + kMorePatience * shareOf(request.id, stand_offs_ + 1000));
  const Eigen::Vector2d towards = (here - other).normalized();
  const Path through = {other, here, here + kStrangerReach * towards};
  stranger_ = PeerTube{0,
                       {3.0, 0, 0},
                       footprint_,
                       {other.x(), other.y(), std::atan2(towards.y(), towards.x())},
                       0.0,
                       resampled(through, kTubeStep),
                       options_.peer_margin,
                       true,
                       false};
}

}  // namespace parley

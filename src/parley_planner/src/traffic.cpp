// SPDX-License-Identifier: BSD-3-Clause
#include "traffic.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace parley {

namespace {

constexpr double kBelieved = 3.0;       // [s] a motion told longer ago is not believed
constexpr double kTrackReach = 0.9;     // [m] a track so near to where a peer should be is of that peer,
constexpr double kTrackMiss = 0.45;     // [m] and contradicts it if it is further off
constexpr int kSureTrack = 4;           // [-] scans
constexpr double kBodyGrowth = 0.15;    // [m] returns so far outside a peer's footprint are its own
constexpr int kDeepest = 15;            // [-] through so many robots a right of way is lent
constexpr double kLentFor = 0.6;        // [s] a right of way is kept after it was last needed
constexpr double kNoRoomFor = 1.0;      // [s] without anywhere to make room a robot is shut in,
constexpr double kNoRoomBreak = 0.5;    // [s] with breaks shorter than this,
constexpr double kShutInFor = 20.0;     // [s] for so long
constexpr double kOutStep = 1.0;        // [m] after it got on by so much,
constexpr double kOutAgain = 10.0;      // [m] and until it has come so far and has room
constexpr double kKeepsTo = 0.6;        // [s] for which others surely keep to what they said
constexpr double kUsualSpeed = 1.2;     // [m/s] at which robots are taken to get on
constexpr double kAhead = 1.5;          // [s] by which a robot must be earlier to pass before one that goes first
constexpr double kPassingGap = 0.12;    // [m] between two that pass each other
constexpr double kBodyGap = 0.1;        // [m] that a standing robot leaves beside the other
constexpr double kStuckFor = 2.0;       // [s]
constexpr double kMeansToGo = 0.5;      // [m] of way that says that a peer that stands would rather not
constexpr double kTurningGap = 0.15;    // [m] round one that may turn
constexpr double kUnheard = 0.25;       // [s] for which a peer may not have braked as it had told
constexpr double kDrives = 0.05;        // [m/s] slower peers stand
constexpr double kDrivesOn = 2.0;       // [s] that a peer may drive on as it does, whatever it means to do next,
constexpr double kLongestDriven = 4.0;  // [m] up to so far
constexpr double kAside = 0.25;         // [m] more, up to which two that come towards each other mind each other

double clearOf(const Footprint& a, const Footprint& b) { return 0.5 * (a.width + b.width) + kPassingGap; }

}  // namespace

Traffic::Traffic(const PlannerOptions& options, const Footprint& footprint) : options_(options), footprint_(footprint) {}

void Traffic::reset() {
  peers_.clear();
  tubes_.clear();
  careful_.clear();
  standing_since_.clear();
  lent_until_ = no_room_since_ = no_room_last_ = shut_in_until_ = -1e9;
}

bool Traffic::cannotMakeRoom(double now, const Eigen::Vector2d& here) {
  if (now - no_room_last_ > kNoRoomBreak) no_room_since_ = now;
  no_room_last_ = now;
  if (now - no_room_since_ < kNoRoomFor) return false;
  if (!isShutIn(now)) {
    shut_in_at_ = here;
    came_out_ = 0.0;
  }
  shut_in_until_ = now + kShutInFor;
  return true;
}

/// In the middle of a corridor the right must not end: those that made room would come back.
void Traffic::getsOn(double now, const Eigen::Vector2d& here, bool has_room) {
  if (!isShutIn(now)) return;
  const double out = (here - shut_in_at_).norm();
  if (out > kOutAgain && has_room) return isOutAgain();
  if (out < came_out_ + kOutStep) return;
  came_out_ = out;
  shut_in_until_ = now + kShutInFor;
}

void Traffic::observe(const PlanRequest& request) {
  peers_.clear();
  careful_.clear();
  tubes_.clear();
  for (const PeerMotion& peer : request.peers) {
    if (peer.trajectory.empty() || request.now - peer.heard > kBelieved || contradicted(peer, request)) continue;
    peers_.push_back(peer);
    careful_.push_back(peer);
    if (const double freezes = request.now + kKeepsTo; peer.trajectory.endTime() > freezes) {
      std::vector<TrajectoryPoint> points;
      for (const TrajectoryPoint& point : peer.trajectory.points()) {
        if (point.time < freezes) points.push_back(point);
      }
      points.push_back(peer.trajectory.at(freezes));
      points.back().twist = {};
      careful_.push_back(peer);
      careful_.back().trajectory = SampledTrajectory(std::move(points));
    }
    const double margin = options_.peer_margin + uncertaintyOf(peer);
    tubes_.push_back(tubeOf(peer, request.now, margin));
  }
  noteStanding(request.now);
  boundLentRights();
  withoutPeers(request);
}

/// What was lent counts no more than its holder says of itself by now, if that is heard: else a right that has ended is
/// handed on in circles.
void Traffic::boundLentRights() {
  for (PeerTube& tube : tubes_) {
    if (tube.right.depth == 0) continue;
    const auto holder = std::find_if(tubes_.begin(), tubes_.end(), [&](const PeerTube& other) {
      return other.id == tube.right.holder && other.right.depth == 0;
    });
    if (holder != tubes_.end()) tube.right.priority = std::min(tube.right.priority, holder->right.priority);
  }
}

void Traffic::noteStanding(double now) {
  std::map<std::uint32_t, double> since;
  for (PeerTube& tube : tubes_) {
    if (!tube.standing) continue;
    const auto before = standing_since_.find(tube.id);
    since[tube.id] = before == standing_since_.end() ? now : before->second;
    const double way = kTubeStep * static_cast<double>(tube.way.size());
    tube.stuck = now - since[tube.id] > kStuckFor && way > kMeansToGo;
  }
  standing_since_ = std::move(since);
}

/// What moves near a peer but not where it says it is belongs to it, and it does not do what it said.
bool Traffic::contradicted(const PeerMotion& peer, const PlanRequest& request) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (const TrackedObject& track : request.tracks) {
    if (!track.has_moved || track.observations < kSureTrack) continue;
    const Eigen::Vector2d expected = peer.trajectory.at(track.stamp).pose.position();
    nearest = std::min(nearest, (track.position - expected).norm());
  }
  return nearest > kTrackMiss + 2.0 * peer.sigma && nearest < kTrackReach;
}

void Traffic::withoutPeers(const PlanRequest& request) {
  scan_ = request.scan;
  tracks_ = request.tracks;
  for (const PeerMotion& peer : peers_) {
    const Pose2 pose = peer.trajectory.at(request.scan.stamp).pose;
    const double growth = kBodyGrowth + uncertaintyOf(peer);
    const Pose2 T_peer_scan = pose.inverse() * request.T_odom_scan;
    for (std::size_t bin = 0; bin < scan_.binCount(); ++bin) {
      const double range = static_cast<double>(scan_.ranges[bin]);
      if (!std::isfinite(range) || !peer.footprint.contains(T_peer_scan * scan_.pointAt(bin, range), growth)) continue;
      scan_.ranges[bin] = std::numeric_limits<float>::quiet_NaN();
    }
    const auto its = [&](const TrackedObject& track) {
      const Pose2 there = peer.trajectory.at(track.stamp).pose;
      return peer.footprint.contains(there.inverse() * track.position, growth + 0.1);
    };
    tracks_.erase(std::remove_if(tracks_.begin(), tracks_.end(), its), tracks_.end());
  }
}

std::vector<TrackedObject> Traffic::oncoming(const Path& way, double now) const {
  std::vector<TrackedObject> result;
  for (const PeerTube& tube : tubes_) {
    PeerTube driven = tube;
    driven.way = wayFrom({driven.way.front(), driven.way.front() + kDrivesOn * tube.speed * tube.pose.direction()},
                         driven.way.front(), kLongestDriven);
    const double clear = clearOf(footprint_, tube.footprint);
    const auto comes = [&](const PeerTube& there) {
      const auto meeting = meetingOf(way, there, clear);
      return meeting && meeting->against;
    };
    if (!comes(tube) && (std::abs(tube.speed) < kDrives || !comes(driven))) continue;
    TrackedObject object;
    object.id = -1;
    object.stamp = now;
    object.position = tube.pose.position();
    object.velocity = tube.speed * tube.pose.direction();
    object.radius = 0.5 * tube.footprint.width + kUnheard * std::abs(tube.speed);
    object.observations = kSureTrack;
    object.moving = object.has_moved = true;
    result.push_back(object);
  }
  return result;
}

RightOfWay Traffic::rightNow(const RightOfWay& own, double now) const {
  return now < lent_until_ && goesBefore(lent_, own) ? lent_ : own;
}

/// Whether this robot's rectangle leaves the peer too little room.
bool Traffic::isIn(const PeerTube& tube, const Pose2& pose) const {
  const double half = 0.5 * tube.footprint.width + kBodyGap;
  const Pose2 T_base_odom = pose.inverse();
  if (tube.stuck && footprint_.contains(T_base_odom * tube.pose.position(), tube.footprint.circumscribedRadius() + kTurningGap)) {
    return true;
  }
  return std::any_of(tube.way.begin(), tube.way.end(), [&](const Eigen::Vector2d& p_odom) {
    const Eigen::Vector2d p = T_base_odom * p_odom;
    const double dx = std::max(0.0, std::abs(p.x()) - 0.5 * footprint_.length);
    const double dy = std::max(0.0, std::abs(p.y()) - 0.5 * footprint_.width);
    return std::hypot(dx, dy) < half;
  });
}

TrafficDecision Traffic::decide(const Path& way, const RightOfWay& own, const TrajectoryPoint& state, double now) {
  TrafficDecision decision;
  decision.right = rightNow(own, now);
  const double pace = std::max(kUsualSpeed, state.twist.speed);
  for (const PeerTube& tube : tubes_) {
    const double clear = clearOf(footprint_, tube.footprint);
    if (const auto near = meetingOf(way, tube, clear + kAside); near && near->head_on) decision.opposite.push_back(tube);
    const bool pushed_by_this = tube.right.holder == own.holder;
    if (pushed_by_this || !goesBefore(tube.right, decision.right)) continue;
    const auto meeting = meetingOf(way, tube, clear);
    // Who has nothing to do any more does not go in front of others either.
    const bool is_in = isIn(tube, state.pose);
    if (!meeting && !is_in) continue;
    if (meeting && !meeting->against && own.priority > 0.0 && !(is_in && tube.stuck)) continue;
    if (is_in) {
      decision.first.push_back(tube);
      decision.in_the_way = true;
      continue;
    }
    const double entered = meeting->peer_enters / std::max(kUsualSpeed, tube.speed);
    const bool first_there = meeting->enters > 0.0 && !meeting->head_on && meeting->leaves / pace + kAhead < entered;
    if (!first_there) decision.first.push_back(tube);
  }
  if (!decision.in_the_way) return decision;
  for (const PeerTube& tube : decision.first) {
    if (tube.right.depth >= kDeepest) continue;  // what goes round in circles without its holder dies out
    const RightOfWay lent{tube.right.priority, tube.right.holder, tube.right.depth + 1};
    if (now >= lent_until_ || goesBefore(lent, lent_)) lent_ = lent;
    lent_until_ = now + kLentFor;
  }
  decision.right = rightNow(own, now);
  return decision;
}

}  // namespace parley

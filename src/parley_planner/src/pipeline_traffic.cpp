// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "emergency_stop.h"
#include "escape_search.h"
#include "parley_geometry/polygon.h"
#include "pipeline.h"

namespace parley {

namespace {

constexpr double kNearPeer = 10.0;       // [m] a peer further off does not matter
constexpr double kClosePeer = 6.0;       // [m]
constexpr double kShutIn = 10.0;         // [-] priority of a robot that has nowhere to go
constexpr double kLongBack = 8.0;        // [m] of way back make the priority higher
constexpr double kPerLongBack = 0.5;     // [-] by so much,
constexpr double kMostBack = 8.0;        // [-] so many times at most
constexpr double kRoomy = 0.75;          // [m] around a place where one robot can pass another,
constexpr double kWellOut = 2.0;         // [m] if it has come so far from where it cannot
constexpr double kWishStays = 0.35;      // [s]
constexpr double kRest = 0.7;            // [s] at its goal before a robot makes room for others
constexpr double kOut = 0.7;             // [m] from the place where it wanted to go, a robot is out again
constexpr double kWaitingGap = 0.8;      // [m] to a peer that this robot waits for
constexpr double kTellReach = 8.0;       // [m] of the way that is told
constexpr double kPassingGap = 0.12;     // [m] between two that pass each other
constexpr double kSeparation = 0.2;      // [m] that two who keep right would like between them
constexpr double kDetour = 1.5;          // [-] times and
constexpr double kDetourMore = 1.0;      // [m] more is not too long a way round peers
constexpr double kPassingOff = 6.0;      // [s] having got stuck, passing by is not tried for so long
constexpr double kFailedFor = 10.0;      // [s] an escape point that could not be reached is not tried for so long
constexpr double kFailedShortly = 3.0;   // [s] and one to which no motion was found for so long
constexpr int kEscapeTries = 3;          // [-] escape points looked at in one plan
constexpr double kStandOff = 0.3;        // [m] that a waiting robot stays before where it could go to
constexpr double kWorthCreeping = 0.3;   // [m] a waiting robot does not move up by less
constexpr double kNearBody = 5.0;        // [m]
constexpr double kSqueezedGap = 0.05;    // [m] to those who stand, and the error of their pose
constexpr double kWorthSqueezing = 1.0;  // [m] towards where another stands, who will make room, less is not tried
constexpr double kAnotherEscape = 1.0;   // [m] an escape point further from the last is another one
constexpr double kCloser = 0.02;         // [m]
constexpr double kBeginning = 0.4;       // [m] of a path

bool comesUnder(const Path& path, const Blocked::Body& body, double more) {
  const Pose2 T_body_odom = body.pose.inverse();
  return std::any_of(path.begin(), path.end(),
                     [&](const Eigen::Vector2d& p) { return body.footprint.contains(T_body_odom * p, body.growth + more); });
}

/// What of a path comes before it is under a body; that its beginning may be is no matter.
Path upToBodies(const Path& path, const std::vector<Blocked::Body>& bodies, double more) {
  Path free = {path.front()};
  for (std::size_t i = 1; i < path.size(); ++i) {
    const bool taken =
        std::any_of(bodies.begin(), bodies.end(), [&](const auto& body) { return comesUnder({path[i]}, body, more); });
    if (taken && (path[i] - path[0]).norm() > kBeginning) break;
    free.push_back(path[i]);
  }
  return free;
}

bool among(const std::vector<PeerTube>& tubes, std::uint32_t id) {
  return std::any_of(tubes.begin(), tubes.end(), [id](const PeerTube& tube) { return tube.id == id; });
}

}  // namespace

bool Planner::Pipeline::isNearPeers(const PlanRequest& request) const {
  const Eigen::Vector2d here = request.odometry.pose.position();
  return std::any_of(traffic_.tubes().begin(), traffic_.tubes().end(),
                     [&](const PeerTube& tube) { return (tube.pose.position() - here).norm() < kNearPeer; });
}

/// With somebody whose way met its own at the last plan, or who is so near that it may the next moment.
bool Planner::Pipeline::isEngaged(const PlanRequest& request) const {
  const Eigen::Vector2d here = request.odometry.pose.position();
  return std::any_of(traffic_.tubes().begin(), traffic_.tubes().end(), [&](const PeerTube& tube) {
    return (tube.pose.position() - here).norm() < (meets_ ? kNearPeer : kClosePeer);
  });
}

/// One that is close, and not behind itself.
bool Planner::Pipeline::isBehindPeer(const TrajectoryPoint& start) const {
  const Eigen::Vector2d here = start.pose.position(), onward = local_goal_ - here;
  return std::any_of(traffic_.tubes().begin(), traffic_.tubes().end(), [&](const PeerTube& tube) {
    const Eigen::Vector2d offset = tube.pose.position() - here;
    const double near = footprint_.circumscribedRadius() + tube.footprint.circumscribedRadius() + kWaitingGap;
    return offset.norm() < near && offset.dot(onward) > 0.0;
  });
}

/// When nobody pushes it. Who has a long way back to where it could let others pass goes before who has not: those who are
/// deep in a corridor come out first, one after the other.
RightOfWay Planner::Pipeline::ownRight(const PlanRequest& request) const {
  if (traffic_.isShutIn(request.now)) return {kShutIn, request.id, 0};
  if (reached_) return {0.0, request.id, 0};
  return {1.0 + kPerLongBack * std::min(kMostBack, std::floor(back_ / kLongBack)), request.id, 0};
}

/// Remembers where there was last room for two, and how far it has come from there of its own will: what drove deep into a
/// corridor keeps its priority until it is well out, else robots push each other back and forth.
void Planner::Pipeline::lookForRoom(const Eigen::Vector2d& here, double now) {
  const bool is_roomy = surroundings_.obstacles().at(here) >= kRoomy && surroundings_.unseen().at(here) >= 0.5 * kRoomy;
  if (!is_roomy) narrow_ = here;
  traffic_.getsOn(now, here, is_roomy);
  if (!room_ || (is_roomy && (!narrow_ || (*narrow_ - here).norm() > kWellOut))) {
    room_ = here;
    back_ = furthest_ = 0.0;
    return;
  }
  const double further = (*room_ - here).norm() - furthest_;
  if (further <= 0.0) return;
  furthest_ += further;
  if (intent_.right.depth == 0) back_ += further;
}

void Planner::Pipeline::tell(const RightOfWay& right, const Path& way) {
  intent_.right = right;
  intent_.way = way;
}

/// Where the robot would go if it were alone: to the local goal, and along the route from there.
Path Planner::Pipeline::desiredWay(const TrajectoryPoint& start) const {
  const FoundPath found = search(usualAttempt(), start);
  if (found.points.empty()) return {start.pose.position()};
  Path way = straightened(surroundings_, found.points, options_.comfort_distance);
  if (!found.reaches) return resampled(way, kTubeStep);
  const Path on = wayFrom(route_.points, way.back(), kTellReach);
  way.insert(way.end(), on.begin() + 1, on.end());
  return wayFrom(way, start.pose.position(), kTellReach);
}

/// To where it makes room, or what it wished at the last plan, or the route if there was nobody to wish it for then.
Path Planner::Pipeline::expectedWay(const PlanRequest& request) const {
  if (escape_) return wayFrom(intent_.way, request.odometry.pose.position(), kTellReach);
  if (request.now - desired_at_ < kWishStays) return desired_;
  return wayFrom(route_.points, request.odometry.pose.position(), kTellReach);
}

/// At the goal, unless somebody needs the place.
PlanResult Planner::Pipeline::rest(const PlanRequest& request, const TrajectoryPoint& start) {
  watch_.reset();
  reached_ = reached_ || request.now - rested_since_ > kRest;
  if (reached_) {
    if (const std::optional<PlanResult> result = makeWay(request, start, request.goal)) return *result;
  }
  tell(ownRight(request), {start.pose.position()});
  escape_.reset();
  return keep(PlanCode::kArrived, "at the goal");
}

/// A robot that would stay where it is, but stands in the way of one that goes first.
std::optional<PlanResult> Planner::Pipeline::makeWay(const PlanRequest& request, const TrajectoryPoint& start,
                                                     const Eigen::Vector2d& back_to) {
  if (!options_.conflict_resolution || !isNearPeers(request)) return std::nullopt;
  const TrafficDecision decision = traffic_.decide({start.pose.position()}, ownRight(request), start, request.now);
  if (!decision.in_the_way) return std::nullopt;
  look(request, start);
  local_goal_ = back_to;
  return makeRoom(decision, request, start);
}

PlanResult Planner::Pipeline::negotiate(const PlanRequest& request, const TrajectoryPoint& start, bool committed_valid) {
  const Path desired = desiredWay(start);
  desired_ = desired;
  desired_at_ = request.now;
  const TrafficDecision decision = traffic_.decide(desired, ownRight(request), start, request.now);
  meets_ = !decision.first.empty() || !decision.opposite.empty();
  if (watch_.level() > 0 && request.now > passing_off_until_) passing_off_until_ = request.now + kPassingOff;
  tell(decision.right, desired);
  if (std::optional<Proposal> proposal = passBy(decision, desired, request, start)) {
    escape_.reset();
    tell(decision.right, wayFrom(proposal->path, start.pose.position(), kTellReach));
    return commit(*proposal);
  }
  if (!decision.first.empty()) return makeRoom(decision, request, start);
  escape_.reset();
  return decided(request, start, bestProposal(request, start), committed_valid);
}

/// Past those who come towards this robot, each keeping right, and round those who stand and those who go first.
std::optional<Proposal> Planner::Pipeline::passBy(const TrafficDecision& decision, const Path& desired,
                                                  const PlanRequest& request, const TrajectoryPoint& start) {
  Blocked blocked;
  const bool keep_right = request.now > passing_off_until_;
  for (const PeerTube& tube : decision.opposite) {
    if (!keep_right) break;
    const double separation = 0.5 * (tube.footprint.width + footprint_.width) + kSeparation;
    const Path middle = keepingRight(tube, desired, separation, surroundings_.obstacles());
    blocked.addStrip(middle, 0.5 * tube.footprint.width + kPassingGap);
  }
  for (const PeerTube& tube : decision.first) {
    if (keep_right && among(decision.opposite, tube.id)) continue;
    if (decision.in_the_way) return std::nullopt;
    blocked.addStrip(tube.way, 0.5 * tube.footprint.width + kPassingGap);
  }
  for (const PeerTube& tube : traffic_.tubes()) {
    if (!tube.standing || among(decision.opposite, tube.id) || among(decision.first, tube.id)) continue;
    blocked.bodies.push_back({tube.pose, tube.footprint, kPassingGap});
  }
  const double corner = footprint_.inscribedRadius() + kCloser;
  const bool any_near = std::any_of(blocked.bodies.begin(), blocked.bodies.end(),
                                    [&](const Blocked::Body& body) { return comesUnder(desired, body, corner); });
  if (blocked.discs.empty() && !any_near) return std::nullopt;
  const Surroundings shape = surroundings_.with(blocked);
  Attempt how = usualAttempt();
  how.shape = &shape;
  how.whole = true;
  how.most = kDetour * std::min(options_.look_ahead, pathLength(desired)) + kDetourMore;
  std::optional<Proposal> proposal = attempt(how, start);
  return isUseful(proposal) ? proposal : std::nullopt;
}

/// Another goes first: up to where its way begins, or off it.
PlanResult Planner::Pipeline::makeRoom(const TrafficDecision& decision, const PlanRequest& request,
                                       const TrajectoryPoint& start) {
  if (decision.in_the_way) {
    if (const std::optional<Proposal> proposal = escape(decision, request, start)) {
      tell(decision.right, wayFrom(proposal->path, start.pose.position(), kTellReach));
      return commit(*proposal, PlanCode::kEscaping);
    }
    // Who stands in the way of where it would make room has to hear of it.
    tell(decision.right, wayFrom(wished_escape_, start.pose.position(), kTellReach));
    return standStill(request, start, PlanCode::kYielding, "another goes first");
  }
  escape_.reset();
  Blocked blocked;
  for (const PeerTube& tube : decision.first) blocked.addStrip(tube.way, 0.5 * tube.footprint.width + kPassingGap);
  const Surroundings shape = surroundings_.with(blocked);
  Attempt how = usualAttempt();
  how.shape = &shape;
  how.trim = kStandOff;
  std::optional<Proposal> proposal = attempt(how, start);
  const bool moves = std::abs(start.twist.speed) > kSlowSpeed;
  if (proposal && (moves || proposal->advance > kWorthCreeping)) {
    tell(decision.right, wayFrom(proposal->path, start.pose.position(), kTellReach));
    return commit(*proposal, PlanCode::kYielding);
  }
  tell(decision.right, {start.pose.position()});
  return standStill(request, start, PlanCode::kYielding, "another goes first");
}

std::optional<Proposal> Planner::Pipeline::escape(const TrafficDecision& decision, const PlanRequest& request,
                                                  const TrajectoryPoint& start) {
  failed_escapes_.erase(std::remove_if(failed_escapes_.begin(), failed_escapes_.end(),
                                       [&](const auto& failed) { return failed.first < request.now; }),
                        failed_escapes_.end());
  if (escape_ && watch_.level() > 0) {
    failed_escapes_.emplace_back(request.now + kFailedFor, *escape_);
    escape_.reset();
    watch_.reset();
  }
  wished_escape_.clear();
  for (int i = 0; i < kEscapeTries; ++i) {
    std::vector<Eigen::Vector2d> failed;
    for (const auto& [until, place] : failed_escapes_) failed.push_back(place);
    const EscapeTask task{surroundings_,    footprint_,     start.pose, local_goal_, decision.first,
                          traffic_.tubes(), decision.right, escape_,    failed};
    const std::optional<Path> path = escapePath(task);
    if (!path) {
      if (i == 0 && failed.empty() && stands(start.twist)) findWayOut(decision, request, start);
      break;
    }
    if (wished_escape_.empty()) wished_escape_ = *path;
    if (std::optional<Proposal> proposal = escapeAlong(*path, request, start)) {
      if (!escape_ || (*escape_ - path->back()).norm() > kAnotherEscape) ++escapes_;
      escape_ = path->back();
      return proposal;
    }
    failed_escapes_.emplace_back(request.now + kFailedShortly, path->back());
    escape_.reset();
  }
  return std::nullopt;
}

/// There is nowhere to make room: others have to, for this robot to come out. One that has no goal left to go to leaves for
/// where others can pass it.
void Planner::Pipeline::findWayOut(const TrafficDecision& decision, const PlanRequest& request, const TrajectoryPoint& start) {
  if (!way_out_ && !traffic_.cannotMakeRoom(request.now, start.pose.position())) return;
  if (!reached_) return;
  if (!way_out_) shut_in_at_ = start.pose.position();
  const EscapeTask task{surroundings_,    footprint_,        start.pose,   local_goal_, decision.first,
                        traffic_.tubes(), ownRight(request), std::nullopt, {},          2.0 * footprint_.circumscribedRadius()};
  std::optional<Path> path = escapePath(task);
  if (!path) path = pathAwayFrom(task, shut_in_at_);
  way_out_ = path ? std::make_optional(path->back()) : std::nullopt;
}

/// Out of where it was shut in.
PlanResult Planner::Pipeline::leave(const PlanRequest& request, const TrajectoryPoint& start, bool committed_valid) {
  look(request, start);
  local_goal_ = *way_out_;
  if ((start.pose.position() - *way_out_).norm() < kOut) {
    const bool has_room = surroundings_.obstacles().at(*way_out_) > 1.8 * footprint_.circumscribedRadius();
    if (!has_room) findWayOut({}, request, start);
    if (has_room || !way_out_) traffic_.isOutAgain();
    if (has_room) way_out_.reset();
    if (way_out_) local_goal_ = *way_out_;
  }
  return negotiate(request, start, committed_valid);
}

/// By the usual manoeuvres, and from standing by a search among positions and headings.
std::optional<Proposal> Planner::Pipeline::escapeAlong(const Path& path, const PlanRequest& request,
                                                       const TrajectoryPoint& start) {
  Attempt how = usualAttempt();
  const Path straight = straightened(surroundings_, path, how.comfort_distance);
  std::optional<Proposal> proposal = along(straight, how, start);
  if (proposal || !stands(start.twist) || request.now - squeezed_at_ < kSqueezePeriod) return proposal;
  squeezed_at_ = request.now;
  return squeezeAlong(straight, start);
}

/// By a search among positions and headings, past teammates as they stand now. Where one stands in the way, it is going to drive
/// on.
std::optional<Proposal> Planner::Pipeline::squeezeAlong(const Path& path, const TrajectoryPoint& start) {
  Attempt how = usualAttempt();
  how.squeeze = true;
  for (const PeerTube& tube : traffic_.tubes()) {
    if ((tube.pose.position() - start.pose.position()).norm() > kNearBody) continue;
    how.bodies.push_back({tube.pose, tube.footprint, kSqueezedGap + std::max(0.0, tube.margin - options_.peer_margin)});
  }
  if (how.bodies.empty()) return along(path, how, start);
  const Path free = upToBodies(resampled(path, kTubeStep), how.bodies, footprint_.inscribedRadius());
  if (pathLength(free) < std::min(kWorthSqueezing, pathLength(path) - kTubeStep)) return std::nullopt;
  Blocked blocked;
  blocked.bodies = how.bodies;
  const Surroundings shape = surroundings_.with(blocked);
  how.shape = &shape;
  return along(free, how, start);
}

/// Standing, or braking to a stand.
PlanResult Planner::Pipeline::standStill(const PlanRequest& request, const TrajectoryPoint& start, PlanCode code,
                                         const std::string& why) {
  if (!stands(start.twist) || (!request.committed.empty() && !stands(request.committed.at(request.start_time).twist))) {
    return brake(request, start, code, why);
  }
  PlanResult result = keep(code, why);
  if (request.committed.empty() || request.committed.endTime() <= request.start_time) return result;
  result.keep_committed = false;
  result.trajectory = SampledTrajectory::standing(start.pose, request.start_time);
  busy_until_ = -1e9;
  return result;
}

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline.h"

#include <algorithm>
#include <cmath>

#include "emergency_stop.h"
#include "local_goal.h"
#include "parley_geometry/timed.h"

namespace parley {

namespace {

constexpr double kWindowRim = 0.4;        // [m] the local goal stays this far inside the window
constexpr double kLastStretch = 0.8;      // [s] so little before it ends at the goal, a trajectory is left alone
constexpr double kLeastMargin = 0.015;    // [m] to single returns, whose noise this is about
constexpr int kNewTrack = 4;              // [-] scans until a thing that does not move is believed to stand
constexpr double kWiderPush = 0.25;       // [m] more, where the usual path led nowhere
constexpr int kGivesUp = 3;               // [-] level of the watch at which a narrow place is taken to be impassable
constexpr double kNarrow = 0.4;           // [m] from the middle of a narrow place to what stands beside it, at most
constexpr double kInPlace = 0.6;          // [m] off a narrow place something fills it
constexpr double kNarrowBegins = 0.2;     // [m] off the robot's middle
constexpr double kBlockedReach = 1.5;     // [m] moving things nearer than this are what blocks
constexpr double kRouteStays = 30.0;      // [s]
constexpr double kSoon = 0.3;             // [s]
constexpr double kWalksThrough = 1.2;     // [s]
constexpr double kLeastPath = 0.01;       // [m] less is no path
constexpr double kOnRoute = 0.5;          // [m] further off, the local goal is not of the route
constexpr double kSettled = 0.3;          // [s] after a trajectory's end the robot stands,
constexpr double kRestsOff = 0.1;         // [m, rad] no further from there than this
constexpr double kLongestForecast = 0.5;  // [s] of the measured state

SightLawOptions sightLaw(const PlannerOptions& options, const Footprint& footprint) {
  SightLawOptions law;
  law.intruder_speed = options.sight_intruder_speed;
  law.intruder_radius = footprint.inscribedRadius();
  law.intruder_clearance = options.sight_clearance;
  law.reaction_time = options.sight_reaction_time;
  law.contact_distance = footprint.length;  // end to end
  law.half_length = 0.5 * footprint.length;
  law.half_width = 0.5 * footprint.width;
  law.least_speed = options.sight_least_speed;
  return law;
}

}  // namespace

Planner::Pipeline::Pipeline(const PlannerOptions& options, const Footprint& footprint, const MotionLimits& limits)
    : options_(options),
      footprint_(footprint),
      limits_(limits),
      manoeuvres_(options, footprint, limits),
      validator_(footprint, limits, options.prediction_time, options.track_margin),
      sight_law_(sightLaw(options, footprint), limits),
      watch_(options.stuck_time),
      traffic_(options, footprint) {}

void Planner::Pipeline::reset() {
  surroundings_ = {};
  sight_law_.reset();
  watch_.reset();
  traffic_.reset();
  intent_ = {};
  escape_.reset();
  way_out_.reset();
  room_.reset();
  narrow_.reset();
  furthest_ = back_ = 0.0;
  failed_escapes_.clear();
  passing_off_until_ = stranger_until_ = stranger_seen_ = blocked_since_ = blocked_last_ = waited_since_ = waited_last_ =
      rested_since_ = -1e9;
  stranger_.reset();
  stand_offs_in_row_ = 0;
  reached_ = meets_ = false;
  path_.clear();
  route_ = {};
  desired_.clear();
  planned_at_ = busy_until_ = squeezed_at_ = touched_until_ = desired_at_ = -1e9;
  arrived_ = false;
}

PlanResult Planner::Pipeline::plan(const PlanRequest& request) {
  if (!usable(request)) return keep(PlanCode::kNoPath, "inputs are not usable");
  if (request.now < planned_at_) reset();  // time went back
  trajectory_time_ = -1.0;
  traffic_.observe(request);
  validator_.observe({request.map, traffic_.scan(), request.T_odom_scan, traffic_.tracks(), traffic_.peers(), intent_.right});
  if (!hasStrayed(request)) return planFrom(request);
  PlanRequest as_driven = request;
  as_driven.committed = safestStop(validator_, request.committed, measuredState(request), limits_, options_.time_step);
  busy_until_ = -1e9;
  PlanResult result = planFrom(as_driven);
  if (!result.keep_committed) return result;
  result.keep_committed = false;
  result.trajectory = as_driven.committed;
  return result;
}

PlanResult Planner::Pipeline::planFrom(const PlanRequest& request) {
  const TrajectoryPoint start = startState(request);
  committed_ = request.committed;
  if ((request.goal - goal_).norm() > 0.05) arrived_ = reached_ = false;
  goal_ = request.goal;
  // What is driven already may come nearer than what is newly committed: noise alone must not stop the robot.
  const Margins least{kLeastMargin, 0.3 * options_.margin_per_speed, options_.creep_speed};
  const bool valid = validator_.checkRest(request.committed, start.time, least).good();

  if (isTouched(request)) return standStill(request, start, PlanCode::kBlocked, "somebody walks into the robot");
  const bool busy =
      valid && !request.committed.empty() && request.start_time < std::min(busy_until_, request.committed.endTime());
  if (busy) return keep(code_, "");
  if (way_out_ && !traffic_.isShutIn(request.now)) way_out_.reset();
  if (way_out_) return leave(request, start, valid);
  if (request.at_goal || arrived(request)) return rest(request, start);
  rested_since_ = request.now;
  if (request.route.exists()) {
    route_ = request.route;
    routed_at_ = request.now;
  } else if (request.now - routed_at_ > kRouteStays || !isNearPeers(request)) {
    route_ = {};  // teammates that stand in a narrow way close it for a while; others do not go away
  }
  if (!route_.exists()) {
    if (const std::optional<PlanResult> result = makeWay(request, start, start.pose.position())) return *result;
    tell(ownRight(request), {start.pose.position()});
    look(request, start);
    local_goal_ = start.pose.position();
    if (const std::optional<PlanResult> result = makeRoomForStranger(request, start)) return *result;
    if (options_.conflict_resolution && stands(start.twist)) standOff(request, start);
    return valid && heedsSight(start) ? keep(PlanCode::kNoRoute, "no route")
                                      : brake(request, start, PlanCode::kNoRoute, "no route");
  }
  if (valid && (mayKeep(request) || endsAtGoal(request))) return keep(code_, "");
  return replan(request, start, valid);
}

/// Who walks into a standing robot does it no harm, but would if it drove on. It may get out of the lidar's sight doing so.
bool Planner::Pipeline::isTouched(const PlanRequest& request) {
  const Pose2 T_base_odom = request.odometry.pose.inverse();
  for (const TrackedObject& track : traffic_.tracks()) {
    const Eigen::Vector2d soon = track.position + kSoon * track.velocity;
    const bool walks = track.moving && track.observations >= kNewTrack && track.velocity.norm() > kSlowSpeed;
    const bool again = request.now < touched_until_ + kWalksThrough && track.observations < kNewTrack;
    if ((walks && footprint_.contains(T_base_odom * soon, track.radius)) ||
        (again && footprint_.contains(T_base_odom * track.position, track.radius))) {
      touched_until_ = request.now + kWalksThrough;
    }
  }
  return request.now < touched_until_;
}

bool Planner::Pipeline::usable(const PlanRequest& request) const {
  return !request.map.empty() && isConsistent(request.map) && request.odometry.pose.isFinite() &&
         std::isfinite(request.odometry.twist.speed) && std::isfinite(request.odometry.twist.turn_rate) &&
         request.T_odom_scan.isFinite() && request.goal.allFinite();
}

TrajectoryPoint Planner::Pipeline::measuredState(const PlanRequest& request) const {
  const Odometry& odometry = request.odometry;
  const double ahead = std::clamp(request.start_time - odometry.stamp, 0.0, kLongestForecast);
  return {request.start_time, integrateTwist(odometry.pose, odometry.twist.speed, odometry.twist.turn_rate, ahead),
          odometry.twist};
}

TrajectoryPoint Planner::Pipeline::startState(const PlanRequest& request) const {
  if (request.committed.empty()) return measuredState(request);
  const TrajectoryPoint intended = request.committed.at(request.start_time);
  if (stands(intended.twist) && stands(request.odometry.twist)) return {request.start_time, request.odometry.pose, {}};
  return intended;
}

/// The controller stopped it, or it slipped: what is committed is not what is driven, and must not be told any longer.
bool Planner::Pipeline::hasStrayed(const PlanRequest& request) const {
  const Odometry& odometry = request.odometry;
  if (request.committed.empty() || odometry.stamp < request.committed.startTime()) return false;
  const TrajectoryPoint expected = request.committed.at(odometry.stamp);
  const bool rests = stands(expected.twist) && stands(odometry.twist) && odometry.stamp > request.committed.endTime() + kSettled;
  const double most = rests ? std::min(kRestsOff, options_.largest_deviation) : options_.largest_deviation;
  return (expected.pose.position() - odometry.pose.position()).norm() > most ||
         std::abs(angleBetween(expected.pose.yaw, odometry.pose.yaw)) > most;
}

bool Planner::Pipeline::arrived(const PlanRequest& request) {
  const double distance = (request.odometry.pose.position() - request.goal).norm();
  const bool standing =
      stands(request.odometry.twist) && (request.committed.empty() || stands(request.committed.at(request.start_time).twist));
  // Having tried for long, anywhere within the tolerance will do.
  const double enough = (arrived_ || watch_.level() > 0 ? 0.9 : 0.5) * request.goal_tolerance;
  arrived_ = distance < enough && (arrived_ || standing);
  return arrived_;
}

bool Planner::Pipeline::mayKeep(const PlanRequest& request) const {
  if (request.committed.empty() || request.start_time >= request.committed.endTime()) return false;
  if (isEngaged(request)) return false;
  const bool alone = std::none_of(request.tracks.begin(), request.tracks.end(),
                                  [](const TrackedObject& track) { return track.has_moved || track.observations < kNewTrack; });
  if (!alone) return false;  // first sight must not wait
  return request.now - planned_at_ < options_.replan_period - 1e-6;
}

bool Planner::Pipeline::endsAtGoal(const PlanRequest& request) const {
  if (request.committed.empty()) return false;
  const double left = request.committed.endTime() - request.start_time;
  const double miss = (request.committed.points().back().pose.position() - request.goal).norm();
  return left > -kLastStretch && left < kLastStretch && miss < 0.3 * request.goal_tolerance;
}

void Planner::Pipeline::look(const PlanRequest& request, const TrajectoryPoint& start) {
  surroundings_ = Surroundings(request.map, traffic_.scan(), request.T_odom_scan, traffic_.tracks());
  speed_bound_ = limits_.speed;
  if (options_.sight_law) {
    sight_law_.setTeamKnown(request.team_known);
    std::vector<TrackedObject> moving = traffic_.oncoming(expectedWay(request), request.now);
    moving.insert(moving.end(), traffic_.tracks().begin(), traffic_.tracks().end());
    sight_law_.observe(surroundings_, traffic_.scan(), request.T_odom_scan, moving, start.pose, request.now);
    const double gap = sight_law_.gapAt(start.pose.position(), start.twist.speed < 0.0);
    speed_bound_ = std::min(limits_.speed, sight_law_.speedFor(gap));
  }
  lookForRoom(start.pose.position(), request.now);
  if (!route_.exists()) return;
  local_goal_ = localGoal(route_, request.odometry.pose.position(), options_.look_ahead, request.map.frame, kWindowRim);
  watch_.update(request.odometry.pose.position(), request.now);
}

PlanResult Planner::Pipeline::replan(const PlanRequest& request, const TrajectoryPoint& start, bool committed_valid) {
  planned_at_ = request.now;
  look(request, start);
  if (const std::optional<PlanResult> result = makeRoomForStranger(request, start)) return *result;
  if (options_.conflict_resolution && isNearPeers(request)) return negotiate(request, start, committed_valid);
  tell(ownRight(request), {start.pose.position()});
  return decided(request, start, bestProposal(request, start), committed_valid);
}

PlanResult Planner::Pipeline::decided(const PlanRequest& request, const TrajectoryPoint& start,
                                      const std::optional<Proposal>& proposal, bool committed_valid) {
  if (proposal) return commit(*proposal);
  if (options_.conflict_resolution && !traffic_.peers().empty() && isBehindPeer(start)) {
    if (stands(start.twist)) outwait(request, start);
    return committed_valid && heedsSight(start)
               ? keep(stands(start.twist) ? PlanCode::kWaiting : PlanCode::kDriving, "waiting for a teammate")
               : brake(request, start, PlanCode::kWaiting, "waiting for a teammate");
  }
  if (options_.conflict_resolution && stands(start.twist)) standOff(request, start);
  const std::string why = somethingMoved(request) ? "blocked by something that moved" : "blocked";
  PlanResult result = committed_valid && heedsSight(start)
                          ? keep(stands(start.twist) ? PlanCode::kBlocked : PlanCode::kDriving, why)
                          : brake(request, start, PlanCode::kBlocked, why);
  if (stands(start.twist) && watch_.level() >= kGivesUp) result.impassable = narrowPlaceAhead(request);
  if (result.impassable) watch_.reset();  // should nothing else lead there, it tries anew
  return result;
}

/// The narrowest place of the route just ahead, unless something that may drive off is in it; none if it is not narrow.
std::optional<Eigen::Vector2d> Planner::Pipeline::narrowPlaceAhead(const PlanRequest& request) const {
  const Eigen::Vector2d here = request.odometry.pose.position();
  std::optional<Eigen::Vector2d> narrowest;
  double least = kNarrow;
  for (const Eigen::Vector2d& p : wayFrom(route_.points, here, kBlockedReach)) {
    const double room = surroundings_.obstacles().at(p);
    if (room >= least || (p - here).norm() < kNarrowBegins) continue;
    least = room;
    narrowest = p;
  }
  if (!narrowest) return std::nullopt;
  const auto drives = [&](const TrackedObject& track) {
    return track.has_moved && (track.position - *narrowest).norm() < kInPlace + track.radius;
  };
  const auto is_there = [&](const PeerTube& tube) { return (tube.pose.position() - *narrowest).norm() < 2.0 * kInPlace; };
  const bool taken = std::any_of(traffic_.tracks().begin(), traffic_.tracks().end(), drives) ||
                     std::any_of(traffic_.tubes().begin(), traffic_.tubes().end(), is_there);
  return taken ? std::nullopt : narrowest;
}

Planner::Pipeline::Attempt Planner::Pipeline::usualAttempt() const {
  const Margins margins{watch_.level() > 0 ? options_.margin_tight : options_.margin_creeping, options_.margin_per_speed,
                        options_.creep_speed};
  return {footprint_.inscribedRadius() + 0.01, options_.comfort_distance, options_.push_distance, margins, false};
}

std::optional<Proposal> Planner::Pipeline::bestProposal(const PlanRequest& request, const TrajectoryPoint& start) {
  std::optional<Proposal> best;
  const auto consider = [&best](std::optional<Proposal> other) {
    if (other && (!best || other->advance > best->advance + 0.5 * kUsefulAdvance)) best = std::move(other);
  };
  const Attempt usual = usualAttempt();
  consider(attempt(usual, start));
  if (isUseful(best) || std::abs(start.twist.speed) > kSlowSpeed) return best;
  // Wider round corners; where any heading fits, none is in the way.
  const double round = footprint_.circumscribedRadius() + usual.margins.creeping;
  const Attempt wide{round, options_.comfort_distance + kWiderPush, options_.push_distance + kWiderPush, usual.margins, false};
  consider(attempt(wide, start));
  if (isUseful(best) || !stands(start.twist) || request.now - squeezed_at_ < kSqueezePeriod) return best;
  squeezed_at_ = request.now;
  const FoundPath found = search(usual, start);
  if (!found.points.empty()) consider(squeezeAlong(straightened(surroundings_, found.points, usual.comfort_distance), start));
  return best;
}

/// The route up to the local goal; empty if that is not on it.
Path Planner::Pipeline::routeToLocalGoal(const Eigen::Vector2d& here) const {
  Path way = wayFrom(route_.points, here, options_.look_ahead + kOnRoute);
  const auto last = std::min_element(way.begin(), way.end(), [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return (a - local_goal_).squaredNorm() < (b - local_goal_).squaredNorm();
  });
  if ((*last - local_goal_).norm() > kOnRoute) return {};
  way.erase(last + 1, way.end());
  return way;
}

FoundPath Planner::Pipeline::search(const Attempt& how, const TrajectoryPoint& start) const {
  PathSearchOptions search;
  search.least_clearance = how.least_clearance;
  search.comfort_distance = how.comfort_distance;
  search.clearance_weight = options_.clearance_weight;
  search.unknown_cost = options_.unknown_cost;
  search.keep_discount = options_.keep_path_discount;
  return searchPath(how.shape != nullptr ? *how.shape : surroundings_, start.pose.position(), local_goal_, path_, search,
                    routeToLocalGoal(start.pose.position()));
}

std::optional<Proposal> Planner::Pipeline::attempt(const Attempt& how, const TrajectoryPoint& start) {
  const Surroundings& shape = how.shape != nullptr ? *how.shape : surroundings_;
  const FoundPath found = search(how, start);
  if (found.points.empty() || (how.whole && (!found.reaches || pathLength(found.points) > how.most))) return std::nullopt;
  Path path = straightened(shape, found.points, how.comfort_distance);
  if (!found.reaches && how.trim > 0.0) path = shortened(path, how.trim);
  return path.size() < 2 ? std::nullopt : along(path, how, start);
}

/// A motion along a path, if the validator lets it pass.
std::optional<Proposal> Planner::Pipeline::along(const Path& path, const Attempt& how, const TrajectoryPoint& start) {
  if (pathLength(path) < kLeastPath) return std::nullopt;
  const Surroundings& shape = how.shape != nullptr ? *how.shape : surroundings_;
  const DriveScene scene{surroundings_,         traffic_.tracks(),  options_.prediction_time,
                         options_.track_margin, traffic_.careful(), options_.peer_margin};
  const ManoeuvreTask task{path,
                           start,
                           committed_,
                           scene,
                           how.margins,
                           how.push_distance,
                           options_.sight_law ? &sight_law_ : nullptr,
                           shape.obstacles(),
                           how.bodies,
                           how.shape};
  std::optional<Proposal> proposal;
  const double time = timed([&] { proposal = how.squeeze ? manoeuvres_.squeeze(task) : manoeuvres_.propose(task); });
  trajectory_time_ = std::max(0.0, trajectory_time_) + time;
  if (!proposal) return std::nullopt;
  const Margins judged{std::max(kLeastMargin + 0.005, 0.4 * how.margins.creeping), 0.5 * how.margins.per_speed,
                       how.margins.creep_speed};
  return validator_.check(proposal->trajectory, start, judged).good() ? proposal : std::nullopt;
}

bool Planner::Pipeline::somethingMoved(const PlanRequest& request) const {
  const Eigen::Vector2d here = request.odometry.pose.position();
  return std::any_of(request.tracks.begin(), request.tracks.end(),
                     [&](const TrackedObject& track) { return (track.position - here).norm() < kBlockedReach + track.radius; });
}

}  // namespace parley

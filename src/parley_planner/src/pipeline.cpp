// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline.h"

#include <algorithm>
#include <cmath>

#include "parley_geometry/polygon.h"

namespace parley {

namespace {

constexpr double kStandingSpeed = 0.02;     // [m/s] [rad/s] slower counts as standing
constexpr double kSlowSpeed = 0.3;          // [m/s] slower than this, a turn on the spot may be called for
constexpr double kWindowRim = 0.4;          // [m] the local goal stays this far inside the window
constexpr double kDirectionReach = 0.5;     // [m] a path's first direction is that to a point so far along it
constexpr double kLastStretch = 0.8;        // [s] so little before it ends at the goal, a trajectory is left alone
constexpr double kUsefulAdvance = 0.25;     // [m] a drive that gets less far is worth looking for another
constexpr double kTurnWhileMoving = 1.9;    // [rad] off the heading, a moving robot stops first

MotionLimits shareOf(const MotionLimits& limits, double share) {
  return {limits.speed, limits.turn_rate * share, limits.acceleration * share, limits.turn_acceleration * share};
}

SightLawOptions sightLaw(const PlannerOptions& options, const Footprint& footprint) {
  SightLawOptions law;
  law.intruder_speed = options.sight_intruder_speed;
  law.intruder_radius = footprint.inscribedRadius();
  law.intruder_clearance = options.sight_clearance;
  law.reaction_time = options.sight_reaction_time;
  law.contact_distance = 0.25 * (3.0 * footprint.length + footprint.width);  // between end to end and end to side
  law.least_speed = options.sight_least_speed;
  return law;
}

double firstDirection(const Path& path) {
  const Path fine = resampled(path, kDirectionReach);
  const Eigen::Vector2d step = fine[1] - fine[0];
  return std::atan2(step.y(), step.x());
}

bool stands(const Twist2& twist) {
  return std::abs(twist.speed) < kStandingSpeed && std::abs(twist.turn_rate) < kStandingSpeed;
}

}  // namespace

Planner::Pipeline::Pipeline(const PlannerOptions& options, const Footprint& footprint, const MotionLimits& limits)
    : options_(options),
      footprint_(footprint),
      limits_(limits),
      generator_(footprint, shareOf(limits, options.limit_share), options.time_step),
      validator_(footprint, limits, options.prediction_time, options.track_margin),
      sight_law_(sightLaw(options, footprint), limits) {}

void Planner::Pipeline::reset() {
  surroundings_ = {};
  sight_law_.reset();
  path_.clear();
  planned_at_ = busy_until_ = -1e9;
  arrived_ = false;
}

PlanResult Planner::Pipeline::plan(const PlanRequest& request) {
  if (!usable(request)) return keep(PlanCode::kNoPath, "inputs are not usable");
  if (request.now < planned_at_) reset();  // time went back
  const TrajectoryPoint start = startState(request);
  validator_.observe({request.map, request.scan, request.T_odom_scan, request.tracks});
  const Margins least{0.0, 0.3 * options_.margin_per_speed, options_.creep_speed};
  const bool valid = validator_.checkRest(request.committed, start.time, least).good();

  if ((request.goal - goal_).norm() > 0.05) arrived_ = false;
  goal_ = request.goal;
  if (arrived(request)) return keep(PlanCode::kArrived, "at the goal");
  if (!request.route.exists()) {
    return valid ? keep(PlanCode::kNoRoute, "no route") : brake(request, start, PlanCode::kNoRoute, "no route");
  }
  if (valid && (mayKeep(request) || endsAtGoal(request))) return keep(PlanCode::kDriving, "");
  return replan(request, start, valid);
}

bool Planner::Pipeline::usable(const PlanRequest& request) const {
  return !request.map.empty() && isConsistent(request.map) && request.odometry.pose.isFinite() &&
         std::isfinite(request.odometry.twist.speed) && std::isfinite(request.odometry.twist.turn_rate) &&
         request.T_odom_scan.isFinite() && request.goal.allFinite();
}

TrajectoryPoint Planner::Pipeline::startState(const PlanRequest& request) const {
  const Odometry& odometry = request.odometry;
  const double ahead = std::clamp(request.start_time - odometry.stamp, 0.0, 0.5);
  const TrajectoryPoint measured{request.start_time,
                                 integrateTwist(odometry.pose, odometry.twist.speed, odometry.twist.turn_rate, ahead),
                                 odometry.twist};
  if (request.committed.empty()) return measured;
  const TrajectoryPoint intended = request.committed.at(request.start_time);
  if (stands(intended.twist) && stands(odometry.twist)) return {request.start_time, odometry.pose, {}};
  const Pose2 expected = request.committed.at(odometry.stamp).pose;
  const bool started = odometry.stamp >= request.committed.startTime();
  const bool off = (expected.position() - odometry.pose.position()).norm() > options_.largest_deviation ||
                   std::abs(angleBetween(expected.yaw, odometry.pose.yaw)) > options_.largest_deviation;
  return started && off ? measured : intended;
}

bool Planner::Pipeline::arrived(const PlanRequest& request) {
  const double distance = (request.odometry.pose.position() - request.goal).norm();
  const bool standing = stands(request.odometry.twist) &&
                        (request.committed.empty() || stands(request.committed.at(request.start_time).twist));
  if (arrived_) {
    arrived_ = distance < 0.9 * request.goal_tolerance;
  } else {
    arrived_ = standing && distance < 0.5 * request.goal_tolerance;
  }
  return arrived_;
}

Eigen::Vector2d Planner::Pipeline::localGoal(const PlanRequest& request) const {
  // The nearest point of the route first, then on along it.
  const std::vector<Eigen::Vector2d>& points = request.route.points;
  const Eigen::Vector2d here = request.odometry.pose.position();
  std::size_t nearest = 0;
  double best = 1e30, fraction = 0.0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Eigen::Vector2d step = points[i + 1] - points[i];
    const double f = std::clamp((here - points[i]).dot(step) / std::max(1e-9, step.squaredNorm()), 0.0, 1.0);
    const double distance = (points[i] + f * step - here).norm();
    if (distance < best) {
      best = distance;
      nearest = i;
      fraction = f;
    }
  }
  const GridFrame& frame = request.map.frame;
  const Eigen::Vector2d low = frame.origin + Eigen::Vector2d::Constant(kWindowRim);
  const Eigen::Vector2d high = frame.origin + frame.size() - Eigen::Vector2d::Constant(kWindowRim);
  Eigen::Vector2d goal = points[nearest] + fraction * (points[nearest + 1] - points[nearest]);
  double left = options_.look_ahead;
  for (std::size_t i = nearest; i + 1 < points.size(); ++i) {
    const Eigen::Vector2d step = points[i + 1] - goal;
    const int pieces = std::max(1, static_cast<int>(std::ceil(step.norm() / 0.1)));
    for (int k = 0; k < pieces; ++k) {
      const Eigen::Vector2d next = goal + step / pieces;
      left -= step.norm() / pieces;
      if (left < 0.0 || (next.array() < low.array()).any() || (next.array() > high.array()).any()) return goal;
      goal = next;
    }
  }
  return goal;
}

bool Planner::Pipeline::mayKeep(const PlanRequest& request) const {
  if (request.committed.empty() || request.start_time >= request.committed.endTime()) return false;
  if (request.start_time < busy_until_) return true;
  return request.now - planned_at_ < options_.replan_period - 1e-6;
}

bool Planner::Pipeline::endsAtGoal(const PlanRequest& request) const {
  if (request.committed.empty()) return false;
  const double left = request.committed.endTime() - request.start_time;
  const double miss = (request.committed.points().back().pose.position() - request.goal).norm();
  return left > -kLastStretch && left < kLastStretch && miss < 0.3 * request.goal_tolerance;
}

Margins Planner::Pipeline::margins() const {
  return {options_.margin_creeping, options_.margin_per_speed, options_.creep_speed};
}

PlanResult Planner::Pipeline::replan(const PlanRequest& request, const TrajectoryPoint& start, bool committed_valid) {
  planned_at_ = request.now;
  surroundings_ = Surroundings(request.map, request.scan, request.T_odom_scan, request.tracks);
  if (options_.sight_law) {
    sight_law_.observe(surroundings_, request.scan, request.T_odom_scan, request.tracks, start.pose, request.now);
  }
  local_goal_ = localGoal(request);
  PathSearchOptions search;
  search.least_clearance = footprint_.inscribedRadius() + options_.margin_tight;
  search.comfort_distance = options_.comfort_distance;
  search.clearance_weight = options_.clearance_weight;
  search.unknown_cost = options_.unknown_cost;
  search.keep_discount = options_.keep_path_discount;
  const FoundPath found = searchPath(surroundings_, start.pose.position(), local_goal_, path_, search);
  const auto fail = [&](PlanCode code, const std::string& why) {
    return committed_valid ? keep(code, why) : brake(request, start, code, why);
  };
  if (found.points.empty()) return fail(PlanCode::kNoPath, "no path to the route");

  const Path path = straightened(surroundings_, found.points, options_.comfort_distance);
  const DriveScene scene{surroundings_, request.tracks, options_.prediction_time, options_.track_margin};
  const std::optional<Proposal> proposal = propose(path, start, scene, margins());
  if (!proposal) return fail(PlanCode::kBlocked, "blocked");
  const Margins commit{0.3 * options_.margin_creeping, 0.5 * options_.margin_per_speed, options_.creep_speed};
  const Verdict verdict = validator_.check(proposal->trajectory, start, commit);
  if (!verdict.good()) return fail(PlanCode::kBlocked, "plan refused, flaw " + std::to_string(static_cast<int>(verdict.flaw)));
  path_ = proposal->path.points();
  busy_until_ = proposal->busy_until;
  PlanResult result;
  result.status = PlanCode::kDriving;
  result.trajectory = proposal->trajectory;
  result.local_goal = local_goal_;
  result.path = path_;
  result.speed_bound = options_.sight_law ? std::min(limits_.speed, sight_law_.speedFor(sight_law_.gapAt(start.pose.position()))) : limits_.speed;
  if (getenv("DBG")) result.status.text = "bound " + std::to_string(result.speed_bound) + " end " + std::to_string(static_cast<int>(proposal->end)) + " adv " + std::to_string(proposal->advance) + " of " + std::to_string(proposal->path.length());
  return result;
}

std::optional<Planner::Pipeline::Proposal> Planner::Pipeline::propose(const Path& path, const TrajectoryPoint& start,
                                                                      const DriveScene& scene, const Margins& margins) {
  const double off = std::abs(angleBetween(start.pose.yaw, firstDirection(path)));
  const double speed = start.twist.speed;
  if (speed < -kStandingSpeed) return off > 0.5 * kPi ? backOut(path, start, scene, margins) : std::nullopt;
  if (speed > kSlowSpeed) return off < kTurnWhileMoving ? driveOn(path, start, false, scene, margins) : std::nullopt;
  std::optional<Proposal> best;
  if (off < options_.turn_on_spot) {
    best = driveOn(path, start, false, scene, margins);
    if (best && (best->advance > kUsefulAdvance || best->end == DriveEnd::kPathEnd)) return best;
  }
  if (!stands(start.twist)) return best;
  const auto consider = [&best](std::optional<Proposal> other) {
    if (other && (!best || other->advance > best->advance + kUsefulAdvance)) best = std::move(other);
  };
  consider(turnAndDrive(path, start, scene, margins));
  if (best && best->advance > kUsefulAdvance) return best;
  if (off > 0.5 * kPi) consider(backOut(path, start, scene, margins));
  return best;
}

std::optional<Planner::Pipeline::Proposal> Planner::Pipeline::driveOn(const Path& path, const TrajectoryPoint& start,
                                                                      bool reverse, const DriveScene& scene,
                                                                      const Margins& margins) {
  SmoothingOptions smoothing;
  smoothing.push_distance = options_.push_distance;
  smoothing.twisting_weight = options_.twisting_weight;
  smoothing.bending_weight = options_.bending_weight;
  smoothing.iterations = options_.smoothing_iterations;
  const PathStart entry{{start.pose.x, start.pose.y, wrapAngle(start.pose.yaw + (reverse ? kPi : 0.0))},
                        std::abs(start.twist.speed), start.twist.turn_rate};
  Proposal proposal;
  proposal.path = smoothed(path, entry, scene.surroundings.obstacles(), smoothing);
  const double start_s = proposal.path.project(start.pose.position(), 0.0, 1.0);
  const bool bounded = options_.sight_law && !reverse;
  const std::vector<double> sight =
      bounded ? sight_law_.bounds(proposal.path, start_s, start.twist.speed) : std::vector<double>{};
  GeneratedDrive drive = generator_.along(proposal.path, start, reverse, scene, margins, sight);
  if (drive.end == DriveEnd::kInfeasible) return std::nullopt;
  proposal.end = drive.end;
  proposal.advance = drive.advance;
  proposal.trajectory = SampledTrajectory(std::move(drive.drive.points));
  return proposal;
}

std::optional<Planner::Pipeline::Proposal> Planner::Pipeline::turnAndDrive(const Path& path, const TrajectoryPoint& start,
                                                                           const DriveScene& scene,
                                                                           const Margins& margins) {
  std::vector<TrajectoryPoint> points = generator_.turn(start, firstDirection(path), scene, margins);
  if (points.empty()) return std::nullopt;
  const double turned_at = points.back().time;
  std::optional<Proposal> rest = driveOn(path, points.back(), false, scene, margins);
  if (rest) {
    const std::vector<TrajectoryPoint>& driven = rest->trajectory.points();
    points.insert(points.end(), driven.begin() + 1, driven.end());
  } else {
    rest.emplace();
    rest->path = ReferencePath(path);
  }
  rest->trajectory = SampledTrajectory(std::move(points));
  rest->busy_until = turned_at;
  return rest;
}

std::optional<Planner::Pipeline::Proposal> Planner::Pipeline::backOut(const Path& path, const TrajectoryPoint& start,
                                                                      const DriveScene& scene, const Margins& margins) {
  // Back to the first place where there is room to turn.
  const double room = footprint_.circumscribedRadius() + margins.creeping + 0.02;
  Path back = resampled(path, 0.1);
  for (std::size_t i = 3; i < back.size(); ++i) {
    if (scene.surroundings.obstacles().at(back[i]) < room) continue;
    back.resize(std::min(back.size(), i + 2));
    break;
  }
  std::optional<Proposal> proposal = driveOn(back, start, true, scene, margins);
  if (proposal) proposal->busy_until = proposal->trajectory.endTime();
  return proposal;
}

PlanResult Planner::Pipeline::brake(const PlanRequest& request, const TrajectoryPoint& start, PlanCode code,
                                    const std::string& why) {
  if (stands(start.twist) && request.committed.empty()) {
    PlanResult result = keep(code, why);
    result.keep_committed = false;
    result.trajectory = SampledTrajectory::standing(start.pose, start.time);
    return result;
  }
  busy_until_ = -1e9;
  PlanResult result = keep(code, why);
  result.keep_committed = false;
  result.trajectory = brakingTrajectory(start, limits_, options_.time_step);
  return result;
}

PlanResult Planner::Pipeline::keep(PlanCode code, const std::string& why) const {
  PlanResult result;
  result.status = {code, why};
  result.keep_committed = true;
  result.local_goal = local_goal_;
  result.path = path_;
  result.speed_bound = limits_.speed;
  return result;
}

}  // namespace parley

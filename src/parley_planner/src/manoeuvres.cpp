// SPDX-License-Identifier: BSD-3-Clause
#include "manoeuvres.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "emergency_stop.h"
#include "narrow_search.h"
#include "parley_geometry/polygon.h"

namespace parley {

namespace {

constexpr double kStandingSpeed = 0.02;   // [m/s] [rad/s]
constexpr double kDirectionReach = 0.5;   // [m] a path's first direction is that to a point so far along it
constexpr double kTurnWhileMoving = 1.9;  // [rad] off the heading, a moving robot stops first
constexpr double kWorthStarting = 0.04;   // [m] drives that get less far are not worth starting
constexpr double kSqueezeReach = 1.2;     // [m] along the path, at least, to where the search for narrow places leads
constexpr double kSqueezeMost = 3.0;      // [m] and at most
constexpr double kSqueezeStep = 0.1;      // [m] between the points looked at

MotionLimits shareOf(const MotionLimits& limits, double share) {
  return {limits.speed, limits.turn_rate * share, limits.acceleration * share, limits.turn_acceleration * share};
}

double firstDirection(const Path& path) {
  const Path fine = resampled(path, kDirectionReach);
  const Eigen::Vector2d step = fine[1] - fine[0];
  return std::atan2(step.y(), step.x());
}

}  // namespace

bool isUseful(const std::optional<Proposal>& proposal) {
  return proposal && (proposal->advance > kUsefulAdvance || proposal->end == DriveEnd::kPathEnd);
}

bool stands(const Twist2& twist) { return std::abs(twist.speed) < kStandingSpeed && std::abs(twist.turn_rate) < kStandingSpeed; }

Manoeuvres::Manoeuvres(const PlannerOptions& options, const Footprint& footprint, const MotionLimits& limits)
    : options_(options),
      footprint_(footprint),
      generator_(footprint, shareOf(limits, options.limit_share), options.time_step),
      refinement_(optimizerOptions(options), footprint, generator_.limits()) {}

std::optional<Proposal> Manoeuvres::propose(const ManoeuvreTask& task) const {
  const double off = std::abs(angleBetween(task.start.pose.yaw, firstDirection(task.path)));
  const double speed = task.start.twist.speed;
  if (speed < -kStandingSpeed) return off > 0.5 * kPi ? backOut(task) : std::nullopt;
  if (speed > kSlowSpeed) return off < kTurnWhileMoving ? driveOn(task, task.start, false, task.path) : stop(task);
  if (speed > kStandingSpeed && off > kTurnWhileMoving) return stop(task);
  std::optional<Proposal> best;
  if (off < options_.turn_on_spot) best = driveOn(task, task.start, false, task.path);
  if (isUseful(best) || !stands(task.start.twist)) return best;
  const auto consider = [&best](std::optional<Proposal> other) {
    if (other && (!best || other->advance > best->advance + 0.5 * kUsefulAdvance)) best = std::move(other);
  };
  consider(turnAndDrive(task));
  if (!isUseful(best) && off > 0.5 * kPi) consider(backOut(task));
  if (best && best->advance < kWorthStarting && best->end != DriveEnd::kPathEnd) return std::nullopt;
  return best;
}

std::optional<Proposal> Manoeuvres::driveOn(const ManoeuvreTask& task, const TrajectoryPoint& start, bool reverse,
                                            const Path& path) const {
  SmoothingOptions smoothing;
  smoothing.push_distance = task.push_distance;
  smoothing.twisting_weight = options_.twisting_weight;
  smoothing.bending_weight = options_.bending_weight;
  smoothing.iterations = options_.smoothing_iterations;
  const PathStart entry{{start.pose.x, start.pose.y, wrapAngle(start.pose.yaw + (reverse ? kPi : 0.0))},
                        std::abs(start.twist.speed),
                        start.twist.turn_rate};
  DrivenPath driven{smoothed(path, entry, task.shape, smoothing), {}, {}};
  const double start_s = driven.path.project(start.pose.position(), 0.0, 1.0);
  if (task.sight_law) driven.sight_bounds = task.sight_law->bounds(driven.path, start_s, start.twist.speed, reverse);
  if (reverse) {
    driven.sight_bounds.resize(driven.path.points().size(), options_.reverse_speed);
    for (double& bound : driven.sight_bounds) bound = std::min(bound, options_.reverse_speed);
  }
  driven.drive = generator_.along(driven.path, start, reverse, task.scene, task.margins, driven.sight_bounds);
  if (driven.drive.end == DriveEnd::kInfeasible) return std::nullopt;
  if (options_.trajectory_optimization && !reverse) {
    if (std::optional<DrivenPath> better = refinement_.refined(task, driven, generator_)) driven = std::move(*better);
  }
  GeneratedDrive& drive = driven.drive;
  return Proposal{SampledTrajectory(std::move(drive.drive.points)), driven.path.points(), drive.end, drive.advance, 0.0};
}

/// The way has turned back: every metre on is to be driven twice. Braking along what was committed meets nothing that this would
/// not have met; on the curve of the moment it may, where that was about to bend back from a wall.
Proposal Manoeuvres::stop(const ManoeuvreTask& task) const {
  const MotionLimits& limits = generator_.limits();
  SampledTrajectory trajectory = task.committed.empty() ? brakingTrajectory(task.start, limits, options_.time_step)
                                                        : brakingAlong(task.committed, task.start, limits, options_.time_step);
  return {std::move(trajectory), task.path, DriveEnd::kPathEnd, 0.0, 0.0};
}

std::optional<Proposal> Manoeuvres::turnAndDrive(const ManoeuvreTask& task) const {
  std::vector<TrajectoryPoint> points = generator_.turn(task.start, firstDirection(task.path), task.scene, task.margins);
  if (points.empty()) return std::nullopt;
  const double turned_at = points.back().time;
  std::optional<Proposal> rest = driveOn(task, points.back(), false, task.path);
  if (!rest) return std::nullopt;
  const std::vector<TrajectoryPoint>& driven = rest->trajectory.points();
  points.insert(points.end(), driven.begin() + 1, driven.end());
  rest->trajectory = SampledTrajectory(std::move(points));
  rest->busy_until = turned_at;
  return rest;
}

std::optional<Proposal> Manoeuvres::backOut(const ManoeuvreTask& task) const {
  // Back to the first place where there is room to turn.
  const double room = footprint_.circumscribedRadius() + task.margins.creeping + 0.02;
  Path back = resampled(task.path, 0.1);
  for (std::size_t i = 3; i < back.size(); ++i) {
    if (task.scene.surroundings.obstacles().at(back[i]) < room) continue;
    back.resize(std::min(back.size(), i + 2));
    break;
  }
  std::optional<Proposal> proposal = driveOn(task, task.start, true, back);
  if (proposal) proposal->busy_until = proposal->trajectory.endTime();
  return proposal;
}

/// The first point of a path, far enough along, with room for any heading; else the last that is in seen space with room
/// for the footprint; 0 if there is none worth going to.
std::size_t Manoeuvres::squeezeTarget(const Path& fine, const ManoeuvreTask& task) const {
  const double room = footprint_.circumscribedRadius() + task.margins.creeping;
  const double least = footprint_.inscribedRadius();
  const Surroundings& around = task.with_them != nullptr ? *task.with_them : task.scene.surroundings;
  std::size_t target = 0;
  for (std::size_t i = 1; i < fine.size() && static_cast<double>(i) <= kSqueezeMost / kSqueezeStep; ++i) {
    const double free = around.obstacles().at(fine[i]);
    if (free < least || around.unseen().at(fine[i]) < least) continue;
    target = i;
    if (free >= room && static_cast<double>(i) >= kSqueezeReach / kSqueezeStep) break;
  }
  return static_cast<double>(target) * kSqueezeStep < kTargetRadius ? 0 : target;
}

std::optional<Proposal> Manoeuvres::squeeze(const ManoeuvreTask& task) const {
  if (!stands(task.start.twist)) return std::nullopt;
  const Path fine = resampled(task.path, kSqueezeStep);
  const std::size_t target = squeezeTarget(fine, task);
  if (target == 0) return std::nullopt;
  NarrowSearchOptions search;
  search.expansions = options_.narrow_iterations;
  search.clearance = task.margins.creeping;
  search.bodies = task.bodies;
  search.with_them = task.with_them;
  TrajectoryPoint start = task.start;
  start.twist = {};
  std::vector<TrajectoryPoint> points = searchNarrow(start, fine[target], task.scene.surroundings, generator_.probe(),
                                                     generator_.limits(), options_.time_step, search);
  if (points.size() < 2) return std::nullopt;
  const double until = points.back().time;
  return Proposal{SampledTrajectory(std::move(points)), task.path, DriveEnd::kPathEnd, kSqueezeStep * static_cast<double>(target),
                  until};
}

}  // namespace parley

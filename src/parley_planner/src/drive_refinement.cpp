// SPDX-License-Identifier: BSD-3-Clause
#include "drive_refinement.h"

#include <algorithm>
#include <cmath>

#include "parley_geometry/angles.h"

namespace parley {

namespace {

constexpr double kWorthwhileWay = 1.0;       // [m] shorter drives are left as they are
constexpr double kSpacing = 0.1;             // [m] between the points of a path
constexpr double kFineTime = 0.01;           // [s] between the points of a curve that are measured
constexpr double kSharpestTurn = 0.6;        // [rad] between neighbouring lines of a path
constexpr double kAdvanceTolerance = 0.05;   // [m]
constexpr double kDistanceTolerance = 0.02;  // [m]
constexpr double kBeside = 0.2;              // [m] along the path, within which its least distance counts
constexpr double kToTheSide = 0.15;          // [m] of a path, where sight is asked too
constexpr double kFaster = 0.99;             // [-] a drive that takes no less time than this share of another's takes the same

/// Where along a path a point is, which lies further on than `from` [m].
double placeOn(const ReferencePath& path, const Eigen::Vector2d& p, double from) {
  return path.project(p, 0.5 * (from + path.length()), 0.5 * (path.length() - from));
}

/// How fast the bound of sight grows to the left of each of a path's points, from the bounds on both sides. [1/s]
std::vector<double> slopesBeside(const ReferencePath& path, const SightLaw& sight, double start_s, double speed) {
  const auto boundsAt = [&](double left) {
    Path points = path.points();
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double yaw = path.at(path.arcLengths()[i]).yaw;
      points[i] += left * Eigen::Vector2d(-std::sin(yaw), std::cos(yaw));
    }
    return sight.bounds(ReferencePath(std::move(points)), start_s, speed);
  };
  const std::vector<double> right = boundsAt(-kToTheSide);
  std::vector<double> slopes = boundsAt(kToTheSide);
  for (std::size_t i = 0; i < slopes.size(); ++i) slopes[i] = (slopes[i] - right[i]) / (2.0 * kToTheSide);
  return slopes;
}

PathStart entryOf(const TrajectoryPoint& start) { return {start.pose, start.twist.speed, start.twist.turn_rate}; }

bool endsAsWell(DriveEnd end, DriveEnd other) { return end == other || end == DriveEnd::kPathEnd; }

/// Less time, or the same and less jerk. What the new drive gets less far counts as time at full speed.
bool isBetter(const GeneratedDrive& drive, double advance, const GeneratedDrive& other, double speed) {
  const auto duration = [](const GeneratedDrive& d) { return d.drive.points.back().time - d.drive.points.front().time; };
  const double time = duration(drive) + (other.advance - advance) / speed;
  if (time < kFaster * duration(other)) return true;
  return time <= duration(other) && squaredJerk(drive.drive.points) < squaredJerk(other.drive.points);
}

}  // namespace

DriveRefinement::DriveRefinement(const OptimizerOptions& options, const Footprint& footprint, const MotionLimits& limits)
    : optimizer_(options, footprint, limits) {}

std::optional<DrivenPath> DriveRefinement::refined(const ManoeuvreTask& task, const DrivenPath& initial,
                                                   const DriveGenerator& generator) const {
  if (initial.drive.end == DriveEnd::kInfeasible || initial.drive.advance < kWorthwhileWay) return std::nullopt;
  const std::vector<TrajectoryPoint>& driven = initial.drive.drive.points;
  const TrajectoryPoint& start = driven.front();
  std::vector<double> slopes;
  const double driven_from = initial.drive.drive.arc_lengths.front();
  if (task.sight_law != nullptr) slopes = slopesBeside(initial.path, *task.sight_law, driven_from, start.twist.speed);
  const std::optional<PiecewiseQuintic> curve = optimizer_.optimized(
      {initial.path, driven, initial.sight_bounds, slopes, task.scene, task.margins, task.shape, task.push_distance});
  if (!curve) return std::nullopt;
  std::optional<ReferencePath> path = pathOf(*curve, entryOf(start), initial.path, initial.drive.drive.arc_lengths.back());
  if (!path || !keepsDistance(*path, initial.path, task.shape, task.push_distance)) return std::nullopt;
  std::vector<double> sight;
  const double start_s = path->project(start.pose.position(), 0.0, 1.0);
  if (task.sight_law != nullptr) sight = task.sight_law->bounds(*path, start_s, start.twist.speed);
  GeneratedDrive drive = generator.along(*path, start, false, task.scene, task.margins, sight);
  if (drive.end == DriveEnd::kInfeasible || !endsAsWell(drive.end, initial.drive.end)) return std::nullopt;
  drive.advance = placeOn(initial.path, drive.drive.points.back().pose.position(), driven_from) - driven_from;
  if (drive.advance < initial.drive.advance - kAdvanceTolerance) return std::nullopt;
  if (!isBetter(drive, drive.advance, initial.drive, generator.limits().speed)) return std::nullopt;
  return DrivenPath{std::move(*path), std::move(sight), std::move(drive)};
}

std::optional<ReferencePath> pathOf(const PiecewiseQuintic& curve, const PathStart& start, const ReferencePath& reference,
                                    double end_s) {
  Path points = leadIn(start, kSpacing);
  const int steps = static_cast<int>(std::ceil(curve.duration() / kFineTime));
  Path fine = {points.back()};
  for (int i = 1; i <= steps; ++i) {
    const Eigen::Vector2d p = curve.at(curve.duration() * i / steps).position;
    if ((p - fine.back()).norm() > 1e-4) fine.push_back(p);
  }
  if (fine.size() < 2 || pathLength(fine) < 2.0 * kSpacing) return std::nullopt;
  const Path even = resampled(fine, kSpacing);
  points.insert(points.end(), even.begin() + 1, even.end());
  for (std::size_t i = 0; i < reference.points().size(); ++i) {
    if (reference.arcLengths()[i] > end_s + 0.5 * kSpacing) points.push_back(reference.points()[i]);
  }
  for (std::size_t i = 2; i < points.size(); ++i) {
    const Eigen::Vector2d a = points[i - 1] - points[i - 2], b = points[i] - points[i - 1];
    if (std::abs(std::atan2(cross(a, b), a.dot(b))) > kSharpestTurn) return std::nullopt;
  }
  return ReferencePath(std::move(points));
}

bool keepsDistance(const ReferencePath& path, const ReferencePath& reference, const DistanceField& shape, double push_distance) {
  double s = 0.0;
  for (const Eigen::Vector2d& p : path.points()) {
    s = reference.project(p, s, 1.0);
    const double distance = shape.at(p) + kDistanceTolerance;
    if (distance >= push_distance) continue;
    double least = push_distance;
    for (double beside = -kBeside; beside < kBeside + 1e-9; beside += 0.5 * kBeside) {
      least = std::min(least, shape.at(reference.at(s + beside).position));
    }
    if (distance < least) return false;
  }
  return true;
}

double squaredJerk(const std::vector<TrajectoryPoint>& points) {
  const auto velocity = [](const TrajectoryPoint& p) -> Eigen::Vector2d {
    return p.twist.speed * Eigen::Vector2d(std::cos(p.pose.yaw), std::sin(p.pose.yaw));
  };
  double sum = 0.0;
  for (std::size_t i = 2; i < points.size(); ++i) {
    const double dt = 0.5 * (points[i].time - points[i - 2].time);
    const Eigen::Vector2d jerk = (velocity(points[i]) - 2.0 * velocity(points[i - 1]) + velocity(points[i - 2])) / (dt * dt);
    sum += jerk.squaredNorm() * dt;
  }
  return sum;
}

}  // namespace parley

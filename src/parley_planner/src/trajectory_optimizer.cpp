// SPDX-License-Identifier: BSD-3-Clause
#include "trajectory_optimizer.h"

#include <ceres/cost_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <algorithm>
#include <cmath>

#include "curve_costs.h"

namespace parley {

namespace {

constexpr double kShortestDrive = 0.5;       // [s]
constexpr double kShortestWay = 0.5;         // [m]
constexpr double kStandingStart = 0.05;      // [m/s] slower than this the acceleration has to say where the robot heads
constexpr double kStartShare = 0.5;          // [-] of the acceleration, at a start from standing
constexpr int kDiscs = 3;                    // that cover the footprint
constexpr double kPeerReach = 1.0;           // [m] teammates further off than this are left out
constexpr double kMarginWeight = 2e4;        // [1/m^2] of a margin that is lacking, per sample
constexpr double kFunctionTolerance = 1e-4;  // [-] relative gain below which no more steps are made

/// The state of a drive at a time, for a knot there. The acceleration is the mean over `span` [s] around it.
FlatState knotAt(const SampledTrajectory& drive, double time, double span) {
  const TrajectoryPoint p = drive.at(time);
  const double from = std::max(drive.startTime(), time - 0.5 * span), to = std::min(drive.endTime(), time + 0.5 * span);
  const double gain = (drive.at(to).twist.speed - drive.at(from).twist.speed) / (to - from);
  const Eigen::Vector2d ahead(std::cos(p.pose.yaw), std::sin(p.pose.yaw)), left(-ahead.y(), ahead.x());
  return {p.pose.position(), p.twist.speed * ahead, gain * ahead + p.twist.speed * p.twist.turn_rate * left};
}

/// The state that is kept. A robot that stands has a heading, but its curve has only one if it accelerates.
FlatState startOf(const SampledTrajectory& drive, double span, double acceleration) {
  FlatState start = knotAt(drive, drive.startTime(), span);
  const double yaw = drive.points().front().pose.yaw, speed = drive.points().front().twist.speed;
  if (speed < kStandingStart) {
    const Eigen::Vector2d ahead(std::cos(yaw), std::sin(yaw));
    start.velocity = std::max(0.0, speed) * ahead;
    start.acceleration = kStartShare * acceleration * ahead;
  }
  return start;
}

CurveVariables beginning(const SampledTrajectory& drive, std::size_t pieces, const MotionLimits& limits) {
  const double each = drive.duration() / static_cast<double>(pieces);
  std::vector<FlatState> knots = {startOf(drive, each, limits.acceleration)};
  for (std::size_t i = 1; i < pieces; ++i) {
    knots.push_back(knotAt(drive, drive.startTime() + static_cast<double>(i) * each, each));
  }
  FlatState end;
  end.position = drive.points().back().pose.position();
  knots.push_back(end);
  return CurveVariables::of(knots, drive.duration());
}

bool solve(CurveVariables& variables, const SampleScene& scene, const std::vector<CurveSample>& samples,
           const OptimizerOptions& options) {
  const std::size_t pieces = variables.knots.size();
  ceres::Problem problem;
  const auto blocksOf = [&](std::size_t piece) {
    std::vector<double*> blocks;
    if (piece > 0) blocks.push_back(variables.knots[piece - 1].data());
    blocks.push_back(variables.knots[piece].data());
    blocks.push_back(&variables.log_duration);
    return blocks;
  };
  const auto startFor = [&](std::size_t piece) { return piece == 0 ? &variables.start : nullptr; };
  for (std::size_t i = 0; i < pieces; ++i) {
    problem.AddResidualBlock(makeJerkCost(startFor(i)).release(), nullptr, blocksOf(i));
  }
  for (const CurveSample& sample : samples) {
    problem.AddResidualBlock(makeSampleCost(startFor(sample.piece), scene, sample, options.weights).release(), nullptr,
                             blocksOf(sample.piece));
  }
  problem.AddResidualBlock(makeTimeCost(options.weights.time, pieces).release(), nullptr, &variables.log_duration);
  problem.SetParameterBlockConstant(variables.knots.back().data());
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  solver.max_num_iterations = options.iterations;
  solver.function_tolerance = kFunctionTolerance;
  solver.num_threads = 1;
  solver.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);
  return summary.IsSolutionUsable() && summary.final_cost < summary.initial_cost;
}

}  // namespace

OptimizerOptions optimizerOptions(const PlannerOptions& options) {
  const TermWeights weights{options.optimization_time_weight, options.optimization_limit_weight, kMarginWeight,
                            options.optimization_push_weight, options.optimization_deviation_weight};
  return {weights, options.optimization_iterations};
}

TrajectoryOptimizer::TrajectoryOptimizer(const OptimizerOptions& options, const Footprint& footprint, const MotionLimits& limits)
    : options_(options), footprint_(footprint), limits_(limits) {}

SampleScene TrajectoryOptimizer::sceneOf(const OptimizationTask& task) const {
  const DistanceField& obstacles = task.scene.surroundings.obstacles();
  SampleScene scene{task.reference, {}, {}, {}, obstacles, task.shape, task.margins, limits_, footprint_.polygon(), {}, 0.0};
  const std::vector<Eigen::Vector2d>& points = task.reference.points();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double sight = i < task.sight_bounds.size() ? task.sight_bounds[i] : limits_.speed;
    scene.speed_bounds.push_back(std::min(limits_.speed, sight));
    scene.speed_slopes.push_back(i < task.sight_slopes.size() ? task.sight_slopes[i] : 0.0);
    scene.distances.push_back(std::min(task.push_distance, task.shape.at(points[i])));
  }
  const DiscCover cover = coverWithDiscs(footprint_, kDiscs);
  for (const double offset : cover.offsets) {
    scene.discs.push_back(cover.along_x ? Eigen::Vector2d(offset, 0.0) : Eigen::Vector2d(0.0, offset));
  }
  scene.disc_radius = cover.radius;
  return scene;
}

/// Samples at fixed shares of the duration. Teammates are where they will be when the drive that it begins with is there.
std::vector<CurveSample> TrajectoryOptimizer::samplesOf(const OptimizationTask& task, const SampledTrajectory& drive,
                                                        std::size_t pieces) const {
  std::vector<CurveSample> samples;
  double s = task.reference.project(drive.points().front().pose.position(), 0.0, 1.0);
  for (std::size_t k = 1; k < pieces * static_cast<std::size_t>(options_.samples); ++k) {
    const double place = static_cast<double>(k) / options_.samples;  // in pieces
    CurveSample sample;
    sample.piece = std::min(pieces - 1, static_cast<std::size_t>(place));
    sample.tau = place - static_cast<double>(sample.piece);
    const double time = drive.startTime() + drive.duration() * place / static_cast<double>(pieces);
    const TrajectoryPoint there = drive.at(time);
    s = task.reference.project(there.pose.position(), s, 1.0);
    sample.near_s = s;
    sample.heading = {std::cos(there.pose.yaw), std::sin(there.pose.yaw)};
    for (const PeerMotion& peer : task.scene.peers) {
      const Pose2 pose = peer.trajectory.at(time).pose;
      const double reach = footprint_.circumscribedRadius() + peer.footprint.circumscribedRadius() + kPeerReach;
      if ((pose.position() - there.pose.position()).norm() > reach) continue;
      sample.peers.push_back({peer.footprint.polygonAt(pose), task.scene.peer_margin + uncertaintyOf(peer)});
    }
    samples.push_back(std::move(sample));
  }
  return samples;
}

std::optional<PiecewiseQuintic> TrajectoryOptimizer::optimized(const OptimizationTask& task) const {
  if (options_.iterations <= 0 || task.drive.size() < 2) return std::nullopt;
  const SampledTrajectory drive(task.drive);
  if (drive.duration() < kShortestDrive || drive.length() < kShortestWay) return std::nullopt;
  const auto wanted = static_cast<int>(std::lround(drive.duration() / options_.piece_duration));
  const auto pieces = static_cast<std::size_t>(std::clamp(wanted, 2, std::max(2, options_.most_pieces)));
  CurveVariables variables = beginning(drive, pieces, limits_);
  const SampleScene scene = sceneOf(task);
  const std::vector<CurveSample> samples = samplesOf(task, drive, pieces);
  if (!solve(variables, scene, samples, options_)) return std::nullopt;
  return variables.curve();
}

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#include "sampling_search.h"

#include <ompl/base/SpaceInformation.h>
#include <ompl/base/goals/GoalSampleableRegion.h>
#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/geometric/PathSimplifier.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/geometric/planners/rrt/RRTstar.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <ctime>

#include "narrow_search.h"
#include "turn_drive_space.h"

namespace parley::study {

namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

constexpr int kShortCutRounds = 5;  // [-] as many as OMPL's own simplification makes

/// A disc round a place, any heading.
class TargetDisc : public ob::GoalSampleableRegion {
 public:
  TargetDisc(const ob::SpaceInformationPtr& information, const Eigen::Vector2d& middle)
      : GoalSampleableRegion(information), middle_(middle) {
    setThreshold(kTargetRadius);
  }
  double distanceGoal(const ob::State* state) const override {
    return (TurnDriveSpace::poseOf(state).position() - middle_).norm();
  }
  void sampleGoal(ob::State* state) const override {
    const double radius = 0.99 * kTargetRadius * std::sqrt(random_.uniform01()), bearing = random_.uniformReal(-kPi, kPi);
    TurnDriveSpace::setPose(state, {middle_.x() + radius * std::cos(bearing), middle_.y() + radius * std::sin(bearing),
                                    random_.uniformReal(-kPi, kPi)});
  }
  unsigned int maxSampleCount() const override { return 1000000; }

 private:
  Eigen::Vector2d middle_;
  mutable ompl::RNG random_;
};

ob::SpaceInformationPtr informationOf(const NarrowProblem& problem, const FootprintProbe& probe, const SamplingOptions& options) {
  const auto space = std::make_shared<TurnDriveSpace>();
  ob::RealVectorBounds bounds(2);
  for (const unsigned axis : {0U, 1U}) {
    const double start = problem.start.position()[axis], target = problem.target[axis];
    bounds.setLow(axis, std::min(start, target) - options.room);
    bounds.setHigh(axis, std::max(start, target) + options.room);
  }
  space->setBounds(bounds);
  const auto information = std::make_shared<ob::SpaceInformation>(space);
  information->setStateValidityChecker([&problem, &probe, &options](const ob::State* state) {
    return probe.clearance(problem.surroundings.obstacles(), TurnDriveSpace::poseOf(state)) >= options.clearance &&
           probe.clearance(problem.surroundings.unseen(), TurnDriveSpace::poseOf(state)) >= 0.0;
  });
  information->setup();
  return information;
}

ob::PlannerPtr plannerOf(const ob::SpaceInformationPtr& information, const SamplingOptions& options) {
  if (!options.optimal) {
    const auto planner = std::make_shared<og::RRTConnect>(information);
    planner->setRange(options.range);
    return planner;
  }
  const auto planner = std::make_shared<og::RRTstar>(information);
  planner->setRange(options.range);
  return planner;
}

/// OMPL's short cuts but for the splines, which a drive that turns on the spot has no use for.
void shorten(const ob::SpaceInformationPtr& information, og::PathGeometric& path) {
  og::PathSimplifier simplifier(information);
  while (simplifier.reduceVertices(path)) {
  }
  simplifier.collapseCloseVertices(path);
  for (int round = 0; round < kShortCutRounds && simplifier.shortcutPath(path); ++round) {
  }
}

void append(std::vector<TrajectoryPoint>& points, const std::vector<TrajectoryPoint>& piece) {
  points.insert(points.end(), piece.begin() + 1, piece.end());
}

void appendTurn(std::vector<TrajectoryPoint>& points, double turn, const MotionLimits& limits, double time_step) {
  while (std::abs(turn) > 1e-9) {
    const double piece = std::clamp(turn, -0.75 * kPi, 0.75 * kPi);
    append(points, turnOnSpot(points.back(), wrapAngle(points.back().pose.yaw + piece), limits, time_step));
    turn -= piece;
  }
}

/// Turns that follow each other are one; the last one has no purpose, because any heading is right.
std::vector<TrajectoryPoint> driven(const og::PathGeometric& path, const Pose2& start, const MotionLimits& limits,
                                    double time_step) {
  std::vector<TrajectoryPoint> points{{0.0, start, {}}};
  double turn = 0.0;
  for (std::size_t i = 1; i < path.getStateCount(); ++i) {
    const TurnDrive motion = turnDriveBetween(TurnDriveSpace::poseOf(path.getState(static_cast<unsigned>(i - 1))),
                                              TurnDriveSpace::poseOf(path.getState(static_cast<unsigned>(i))));
    turn += motion.first_turn;
    if (motion.length != 0.0) {
      appendTurn(points, turn, limits, time_step);
      append(points, driveArc(points.back(), 0.0, motion.length, NarrowSearchOptions().slow_speed, limits, time_step));
      turn = 0.0;
    }
    turn += motion.last_turn;
  }
  return points;
}

}  // namespace

double threadSeconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::vector<TrajectoryPoint> searchBySampling(const NarrowProblem& problem, const FootprintProbe& probe,
                                              const MotionLimits& limits, double time_step, const SamplingOptions& options) {
  ompl::msg::noOutputHandler();
  ompl::RNG::setSeed(options.seed);
  const double until = threadSeconds() + options.time_limit;
  const ob::SpaceInformationPtr information = informationOf(problem, probe, options);
  const auto definition = std::make_shared<ob::ProblemDefinition>(information);
  ob::ScopedState<> start(information);
  TurnDriveSpace::setPose(start.get(), problem.start);
  definition->addStartState(start);
  definition->setGoal(std::make_shared<TargetDisc>(information, problem.target));
  definition->setOptimizationObjective(std::make_shared<ob::PathLengthOptimizationObjective>(information));
  const ob::PlannerPtr planner = plannerOf(information, options);
  planner->setProblemDefinition(definition);
  planner->setup();
  planner->solve(ob::PlannerTerminationCondition([until] { return threadSeconds() > until; }));
  if (!definition->hasExactSolution()) return {};
  auto path = *definition->getSolutionPath()->as<og::PathGeometric>();
  shorten(information, path);
  return driven(path, problem.start, limits, time_step);
}

}  // namespace parley::study

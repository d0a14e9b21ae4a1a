// SPDX-License-Identifier: BSD-3-Clause
#include "team_loop.h"

#include "parley_geometry/polygon.h"

namespace parley {

namespace {

/// As hashes of names, in no order of their place.
std::uint32_t idOf(std::size_t i) { return 2654435761U * static_cast<std::uint32_t>(i + 1); }

}  // namespace

TeamLoop::TeamLoop(const World& world, const std::vector<TeamMember>& members)
    : world_(world), map_(seenMap(world)), router_(world.frame) {
  for (double x = 0.25; x < 10.0; x += 0.5) {
    for (double y = 0.25; y < 10.0; y += 0.5) {
      if (!world.solidAt({x, y})) router_.add(castScan(world, {x, y, 0.0}, 0.0, 0.0, random_), {x, y, 0.0});
    }
  }
  for (const TeamMember& member : members) {
    Robot robot;
    robot.member = member;
    robot.planner = std::make_unique<Planner>(PlannerOptions{}, member.footprint, robotLimits());
    robot.state = {0.0, member.start, {}};
    robots_.push_back(std::move(robot));
  }
}

void TeamLoop::run(double duration) {
  while (now_ < duration && !allReached()) step();
}

bool TeamLoop::allReached() const {
  return std::all_of(robots_.begin(), robots_.end(), [](const Robot& robot) { return robot.reached; });
}

int TeamLoop::escapes() const {
  int sum = 0;
  for (const Robot& robot : robots_) sum += robot.plan.escapes;
  return sum;
}

PeerMotion TeamLoop::motionOf(std::size_t i) const {
  const Robot& robot = robots_[i];
  PeerMotion motion;
  motion.id = idOf(i);
  motion.footprint = robot.member.footprint;
  motion.trajectory = robot.committed.empty() ? SampledTrajectory::standing(robot.state.pose, now_) : robot.committed;
  motion.heard = now_;
  motion.sigma = 0.02;
  motion.intent = robot.plan.intent;
  if (motion.intent.way.empty()) motion.intent = {{1.0, motion.id, 0}, {robot.state.pose.position()}};
  return motion;
}

std::vector<PeerMotion> TeamLoop::others(std::size_t self, const std::vector<PeerMotion>& said) const {
  std::vector<PeerMotion> result;
  for (std::size_t i = 0; i < said.size(); ++i) {
    if (i != self) result.push_back(said[i]);
  }
  return result;
}

void TeamLoop::think(std::size_t i, const std::vector<PeerMotion>& said) {
  Robot& robot = robots_[i];
  const Odometry odometry{now_, robot.state.pose, robot.state.twist, 0.0, 0.0};
  const ObstacleScan scan = castScan(world_, robot.state.pose, now_, 0.01, random_);
  robot.route = router_.route(robot.state.pose.position(), robot.member.goal);
  const std::vector<TrackedObject> tracks;
  PlanRequest request{now_,   now_ + 0.05, odometry,          map_, scan,           robot.state.pose,
                      tracks, robot.route, robot.member.goal, 0.3,  robot.committed};
  request.id = idOf(i);
  request.peers = others(i, said);
  request.team_known = true;
  const bool stands = std::abs(robot.state.twist.speed) < 0.02 && std::abs(robot.state.twist.turn_rate) < 0.02;
  request.at_goal = stands && (robot.state.pose.position() - robot.member.goal).norm() < 0.3;
  robot.plan = robot.planner->plan(request);
  if (request.at_goal && robot.plan.status.is(PlanCode::kArrived)) robot.reached = true;
  if (robot.plan.keep_committed) return;
  const std::string flaw = motionFlaw(robot.plan.trajectory.points(), robotLimits());
  if (!flaw.empty()) flaw_ = "robot " + std::to_string(i) + ": " + flaw;
}

void TeamLoop::step() {
  std::vector<PeerMotion> said;
  for (std::size_t i = 0; i < robots_.size(); ++i) said.push_back(motionOf(i));
  for (std::size_t i = 0; i < robots_.size(); ++i) think(i, said);
  for (int k = 1; k <= 5; ++k) {
    const double time = now_ + 0.02 * k;
    for (Robot& robot : robots_) {
      if (time > now_ + 0.05 - 1e-9 && !robot.plan.keep_committed) robot.committed = robot.plan.trajectory;
      if (!robot.committed.empty()) robot.state = robot.committed.at(time);
    }
    judge();
  }
  now_ += 0.1;
}

void TeamLoop::judge() {
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    const Robot& robot = robots_[i];
    if (world_.touches(robot.member.footprint, robot.state.pose)) ++collisions_;
    const Polygon body = robot.member.footprint.polygonAt(robot.state.pose);
    for (std::size_t j = i + 1; j < robots_.size(); ++j) {
      if (convexOverlap(body, robots_[j].member.footprint.polygonAt(robots_[j].state.pose))) ++collisions_;
    }
  }
}

}  // namespace parley

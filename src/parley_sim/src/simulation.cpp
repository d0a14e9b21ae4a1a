// SPDX-License-Identifier: BSD-3-Clause
#include "parley_sim/simulation.h"

#include <algorithm>

namespace parley::sim {
namespace {

constexpr int kSubsteps = 2;            // of the physics in a step: contacts are judged every 4 cm at 4 m/s
constexpr double kDoorThickness = 0.1;  // [m]
constexpr int kStepsPerEncounterCheck = 5;

Body bodyOf(const RobotSpec& spec) { return {!spec.joins_later, {spec.start, {}}, spec.footprint.length, spec.footprint.width}; }

Box doorBox(const Event& event) { return boxOfSegment(event.from, event.to, kDoorThickness); }

}  // namespace

Simulation::Simulation(const Scenario& scenario, const World& world)
    : scenario_(scenario),
      world_(&world),
      events_(scenario.events),
      radio_(scenario, world),
      referee_(scenario, world),
      encounters_(scenario, world) {
  for (const RobotSpec& spec : scenario.robots) {
    robots_.emplace_back(spec, scenario.seed, static_cast<int>(robots_.size()));
    snapshot_.bodies.push_back(bodyOf(spec));
  }
  for (const MovingObstacleSpec& obstacle : scenario.obstacles) {
    obstacles_.emplace_back(obstacle);
    snapshot_.discs.push_back(obstacles_.back().at(0.0));
  }
}

std::vector<SensorReadings> Simulation::step() {
  events_.advance(snapshot_.time, [this](const Event& event) { return apply(event); });
  std::vector<Pose2> before;
  for (const Body& body : snapshot_.bodies) before.push_back(body.state.pose);
  for (int substep = 0; substep < kSubsteps; ++substep) {
    snapshot_.time = (static_cast<double>(steps_) + (substep + 1.0) / kSubsteps) * kStepTime;
    movePhysics(kStepTime / kSubsteps);
  }
  ++steps_;
  if (steps_ % kStepsPerEncounterCheck == 0) encounters_.observe(snapshot_);

  std::vector<std::vector<Payload>> packets = radio_.deliver(snapshot_.time, radioNodes());
  const Scene seen = scene();
  std::vector<SensorReadings> readings(robots_.size());
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    if (!snapshot_.bodies[i].present) continue;
    readings[i] = robots_[i].sense(before[i], snapshot_.bodies[i].state, seen, snapshot_.time, kStepTime);
    readings[i].packets = std::move(packets[i]);
  }
  return readings;
}

void Simulation::movePhysics(double dt) {
  for (std::size_t i = 0; i < obstacles_.size(); ++i) snapshot_.discs[i] = obstacles_[i].at(snapshot_.time);
  std::vector<Pose2> believed;
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    Body& body = snapshot_.bodies[i];
    if (body.present) {
      const BodyState before = body.state;
      const Twist2 command = robots_[i].wheelCommand(snapshot_.time - dt);
      body.state = drivenUntilContact(*world_, snapshot_, i, command, scenario_.robots[i].limits, dt);
      robots_[i].noteMotion(before, body.state, dt);
    }
    believed.push_back(robots_[i].believed());
  }
  referee_.judge(snapshot_, believed, dt);
}

bool Simulation::apply(const Event& event) {
  SimulatedRobot& robot = robots_[event.robot];
  const double until = snapshot_.time + event.duration;
  switch (event.kind) {
    case EventKind::kDoor:
      return applyDoor(event);
    case EventKind::kJoin:
      return applyJoin(event);
    case EventKind::kKill:
      robot.kill();
      referee_.noteKilled(event.robot);
      return true;
    case EventKind::kStall:
      robot.stallUntil(until);
      return true;
    case EventKind::kMute:
      robot.muteUntil(until);
      return true;
    case EventKind::kBlind:
      robot.blindUntil(until);
      return true;
  }
  return true;
}

bool Simulation::applyDoor(const Event& event) {
  if (event.closed && !isClearOfRobots(doorBox(event))) return false;
  const auto same = [&event](const Event& door) { return sameDoor(event, door); };
  closed_doors_.erase(std::remove_if(closed_doors_.begin(), closed_doors_.end(), same), closed_doors_.end());
  if (event.closed) closed_doors_.push_back(event);
  snapshot_.doors.clear();
  for (const Event& door : closed_doors_) snapshot_.doors.push_back(doorBox(door));
  return true;
}

bool Simulation::applyJoin(const Event& event) {
  Body& body = snapshot_.bodies[event.robot];
  if (!isClearOfRobots(body.box()) || touchesSolid(*world_, snapshot_.doors, body.box())) return false;
  body.present = true;
  referee_.noteJoined(event.robot, snapshot_.time);
  return true;
}

bool Simulation::isClearOfRobots(const Box& box) const {
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    const Body& body = snapshot_.bodies[i];
    if (body.present && distance(body.box(), box) <= brakingDistance(body.state, scenario_.robots[i].limits)) return false;
  }
  return true;
}

Scene Simulation::scene() const {
  Scene scene;
  scene.world = world_;
  for (std::size_t i = 0; i < snapshot_.bodies.size(); ++i) {
    const Body& body = snapshot_.bodies[i];
    if (body.present) scene.boxes.push_back({body.box(), kRobotHeight, static_cast<int>(i)});
  }
  for (const Box& door : snapshot_.doors) scene.boxes.push_back({door, kWallHeight, -1});
  for (const Disc& disc : snapshot_.discs) scene.discs.push_back({disc, kPersonHeight, -1});
  return scene;
}

std::vector<RadioNode> Simulation::radioNodes() const {
  std::vector<RadioNode> nodes;
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    const Body& body = snapshot_.bodies[i];
    nodes.push_back({body.state.pose.position(), body.present && robots_[i].radioOn(snapshot_.time)});
  }
  return nodes;
}

void Simulation::send(std::size_t robot, const Payload& payload) { radio_.send(robot, payload, snapshot_.time, radioNodes()); }

bool Simulation::finished() const {
  constexpr double kSameTime = 1e-9;  // [s]
  return referee_.allReached() || snapshot_.time >= scenario_.duration - kSameTime;
}

}  // namespace parley::sim

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "parley_sim/contacts.h"
#include "parley_sim/encounter_counter.h"
#include "parley_sim/event_queue.h"
#include "parley_sim/moving_obstacle.h"
#include "parley_sim/radio.h"
#include "parley_sim/referee.h"
#include "parley_sim/scenario.h"
#include "parley_sim/simulated_robot.h"
#include "parley_sim/world.h"

namespace parley::sim {

/// A scenario in lockstep: the world, the robots' bodies, sensors and radio, and the referee. The robots' minds are
/// outside: each step hands out what their sensors say and takes what they command for the next.
class Simulation {
 public:
  static constexpr double kStepTime = 0.02;  // [s]

  /// `world` has to outlive the simulation. The scenario's starts must have been checked.
  Simulation(const Scenario& scenario, const World& world);

  /// Goes on by kStepTime: events, physics, referee, radio delivery, sensors. What each robot's computer gets, in the
  /// order of the scenario.
  std::vector<SensorReadings> step();

  /// What a robot's wheels shall do from now on.
  void command(std::size_t robot, const Twist2& twist) { robots_[robot].command(twist); }
  /// Broadcasts a packet now.
  void send(std::size_t robot, const Payload& payload);

  double time() const { return snapshot_.time; }
  /// Every robot has reached its goal, or time is up.
  bool finished() const;

  const Scenario& scenario() const { return scenario_; }
  const World& world() const { return *world_; }
  const Snapshot& truth() const { return snapshot_; }
  const SimulatedRobot& robot(std::size_t index) const { return robots_[index]; }
  const Referee& referee() const { return referee_; }
  const RadioCounters& radio() const { return radio_.counters(); }
  const std::vector<Encounter>& encounters() const { return encounters_.encounters(); }

 private:
  bool apply(const Event& event);
  bool applyDoor(const Event& event);
  bool applyJoin(const Event& event);
  bool isClearOfRobots(const Box& box) const;
  void movePhysics(double dt);
  Scene scene() const;
  std::vector<RadioNode> radioNodes() const;

  Scenario scenario_;
  const World* world_;
  EventQueue events_;
  std::vector<MovingObstacle> obstacles_;
  std::vector<SimulatedRobot> robots_;
  Radio radio_;
  Referee referee_;
  EncounterCounter encounters_;
  Snapshot snapshot_;
  std::vector<Event> closed_doors_;
  long steps_ = 0;
};

}  // namespace parley::sim

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "parley_geometry/motion.h"
#include "parley_geometry/scan.h"
#include "parley_sim/attitude.h"
#include "parley_sim/contacts.h"
#include "parley_sim/odometry_model.h"
#include "parley_sim/planar_lidar.h"
#include "parley_sim/radio.h"
#include "parley_sim/scenario.h"
#include "parley_sim/spatial_lidar.h"

namespace parley::sim {

/// What reaches a robot's computer in one step, stamped by its own clock.
struct SensorReadings {
  bool present = false;  // it stands in the world and its computer runs
  double clock = 0.0;    // [s] the robot's own
  std::optional<Odometry> odometry;
  std::optional<RangeScan> scan;
  std::optional<LidarCloud> cloud;
  std::vector<Payload> packets;
};

/// Says when a sensor with a rate and a phase is due.
class SensorClock {
 public:
  SensorClock(double rate, double phase_fraction) : period_(1.0 / rate), next_(phase_fraction / rate) {}

  double period() const { return period_; }
  bool due(double time);

 private:
  double period_;  // [s]
  double next_;    // [s]
};

/// A robot without its mind: sensors, radio and wheels with whatever has gone wrong with them.
class SimulatedRobot {
 public:
  SimulatedRobot(const RobotSpec& spec, std::uint64_t seed, int index);

  void kill() { dead_ = true; }
  bool dead() const { return dead_; }
  void stallUntil(double time) { stalled_until_ = time; }
  void muteUntil(double time) { muted_until_ = time; }
  void blindUntil(double time) { blind_until_ = time; }

  void command(const Twist2& twist) { command_ = twist; }
  /// What the wheels do of it; they brake when the robot is dead or stalled.
  Twist2 wheelCommand(double time) const { return dead_ || time < stalled_until_ ? Twist2{} : command_; }
  bool radioOn(double time) const { return !dead_ && time >= muted_until_; }
  double clockAt(double time) const { return spec_.clock.at(time); }

  /// T_odom_base as odometry believes it to be.
  const Pose2& believed() const { return odometry_.pose(); }
  void noteMotion(const BodyState& from, const BodyState& to, double dt);

  /// Readings due at the end of a step of `dt` that began at `from`.
  SensorReadings sense(const Pose2& from, const BodyState& body, const Scene& scene, double time, double dt);

 private:
  void senseSpatially(const Pose2& from, const BodyState& body, const Scene& scene, double time, double dt,
                      SensorReadings& readings);

  RobotSpec spec_;
  int index_;
  Attitude attitude_;
  OdometryModel odometry_;
  PlanarLidar planar_;
  SpatialLidar spatial_;
  SensorClock odometry_clock_;
  SensorClock lidar_clock_;
  Twist2 command_;
  bool dead_ = false;
  double stalled_until_ = 0.0;  // [s]
  double muted_until_ = 0.0;    // [s]
  double blind_until_ = 0.0;    // [s]
};

}  // namespace parley::sim

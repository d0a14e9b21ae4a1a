// SPDX-License-Identifier: BSD-3-Clause
#include "parley_sim/simulated_robot.h"

namespace parley::sim {
namespace {

constexpr double kSway = 0.012;           // [rad] of roll and pitch where they matter
constexpr double kAttitudeNoise = 0.001;  // [rad]
constexpr double kWholeTurn = 0.75;       // [-] a spatial lidar that began later than this does not report the turn
constexpr double kSameTime = 1e-9;        // [s]

double phaseOf(std::uint64_t seed, const std::string& robot, const std::string& sensor) {
  return RandomStream(seed, robot, "phase of " + sensor).uniform();
}

/// Planar lidars and odometry know nothing of roll and pitch.
bool sways(const RobotSpec& spec) { return spec.lidar.mode == LidarMode::kSpatial; }

}  // namespace

bool SensorClock::due(double time) {
  if (time + kSameTime < next_) return false;
  while (next_ <= time + kSameTime) next_ += period_;
  return true;
}

SimulatedRobot::SimulatedRobot(const RobotSpec& spec, std::uint64_t seed, int index)
    : spec_(spec),
      index_(index),
      attitude_(sways(spec) ? kSway : 0.0, RandomStream(seed, spec.name, "attitude")),
      odometry_(spec.odometry, sways(spec) ? kAttitudeNoise : 0.0, RandomStream(seed, spec.name, "odometry")),
      planar_(spec.lidar, RandomStream(seed, spec.name, "lidar")),
      spatial_(spec.lidar, RandomStream(seed, spec.name, "lidar")),
      odometry_clock_(spec.odometry.rate, phaseOf(seed, spec.name, "odometry")),
      lidar_clock_(spec.lidar.rate, phaseOf(seed, spec.name, "lidar")) {}

void SimulatedRobot::noteMotion(const BodyState& from, const BodyState& to, double dt) {
  const Twist2 mean{0.5 * (from.twist.speed + to.twist.speed), 0.5 * (from.twist.turn_rate + to.twist.turn_rate)};
  odometry_.advance(from.pose, to.pose, mean, dt);
}

SensorReadings SimulatedRobot::sense(const Pose2& from, const BodyState& body, const Scene& scene, double time, double dt) {
  SensorReadings readings;
  readings.present = !dead_;
  readings.clock = clockAt(time);
  if (dead_) return readings;
  if (odometry_clock_.due(time)) readings.odometry = odometry_.reading(readings.clock, body.twist, attitude_.at(time));
  if (spec_.lidar.mode == LidarMode::kSpatial) {
    senseSpatially(from, body, scene, time, dt, readings);
  } else if (lidar_clock_.due(time) && time >= blind_until_) {
    readings.scan = planar_.scan(readings.clock, body.pose, scene, index_);
  }
  return readings;
}

void SimulatedRobot::senseSpatially(const Pose2& from, const BodyState& body, const Scene& scene, double time, double dt,
                                    SensorReadings& readings) {
  const bool sees = time >= blind_until_;
  if (sees) spatial_.sweep({from, body.pose, time - dt, dt, attitude_.at(time - 0.5 * dt)}, scene, index_);
  if (!lidar_clock_.due(time)) return;
  const double start = spatial_.turnStart();
  LidarCloud cloud = spatial_.finish(clockAt(start));
  if (sees && time - start >= kWholeTurn * lidar_clock_.period() - kSameTime) readings.cloud = std::move(cloud);
}

}  // namespace parley::sim

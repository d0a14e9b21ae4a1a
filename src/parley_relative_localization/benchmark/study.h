// SPDX-License-Identifier: BSD-3-Clause
// What the studies of encounters have in common: what can be varied, where a robot is, what became of an encounter.
#pragma once

#include <vector>

#include "../test/simulated_lidar.h"
#include "parley_geometry/motion.h"
#include "parley_relative_localization/relative_localization_options.h"

namespace parley::study {

constexpr double kPeriod = 0.1;     // [s] of the lidar
constexpr double kLongest = 16.0;   // [s] of an encounter
constexpr double kAfter = 4.0;      // [s] that an encounter is followed after the last sight
constexpr double kNearMiss = 16.0;  // [m] robots that start nearer to each other are not elsewhere

struct StudyOptions {
  test::LidarModel lidar;
  double drift = 1.0;   // [-] times 0.003 m and 0.0002 rad per square root of metre
  double offset = 0.0;  // [s] largest error of the time offset between the robots
  double loss = 0.0;    // [-] share of messages that are lost
  int clutter = 0;      // [-] people about
  double speed = 1.5;   // [m/s]
  RelativeLocalizationOptions localization;
};

/// A robot at an instant.
struct RobotState {
  Pose2 truth, odometry;
  Twist2 twist;
  double travel = 0.0;  // [m]
};

/// An odometry's pose after a motion: what it measures has 0.003 m and 0.0002 rad of noise per square root of metre, `drift`
/// times.
Pose2 driftedOdometry(const Pose2& odometry, const Pose2& motion, double way, double drift, std::mt19937& random);

/// What became of one encounter, as robot 0 knows robot 1.
struct Outcome {
  bool is_encounter = false;  // mutual sight of a second or more
  bool confirmed = false;
  bool tentative = false;
  bool wrong = false;                    // at any time confirmed and more than 0.3 m or 5 degrees off
  double translation_error = 0.0;        // [m] at confirmation
  double rotation_error = 0.0;           // [rad] at confirmation
  double tentative_error = 0.0;          // [m] when first tentative
  double tentative_turn = 0.0;           // [rad] when first tentative
  double consistency = 0.0;              // [-] squared error over covariance at confirmation
  double travel = 0.0;                   // [m] of both from first sight to confirmation
  double seconds = 0.0;                  // [s] from first sight to confirmation
  double sight = 0.0;                    // [s] of mutual sight
  double bytes = 0.0;                    // [-] of keyframes and sightings, a robot
  std::vector<double> descriptor_bytes;  // [-]
  std::vector<double> step_seconds;      // [s] processor time of steps that weighed something
};

/// Errors beyond which a pose is wrong: 0.3 m, 5 degrees.
bool isWrong(double translation, double rotation);

}  // namespace parley::study

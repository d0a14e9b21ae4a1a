// SPDX-License-Identifier: BSD-3-Clause
// One simulated encounter of the study: robots that drive, see, talk and forget messages.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "../test/simulated_lidar.h"
#include "grid_world.h"
#include "parley_relative_localization/relative_localization.h"

namespace parley::study {

struct StudyOptions {
  test::LidarModel lidar;
  double drift = 1.0;   // [-] times 0.003 m and 0.0002 rad per square root of metre
  double offset = 0.0;  // [s] largest error of the time offset between the robots
  double loss = 0.0;    // [-] share of messages that are lost
  int clutter = 0;      // [-] people about
  double speed = 1.5;   // [m/s]
  RelativeLocalizationOptions localization;
};

/// A robot or a person that drives to goals through free space.
class Mover {
 public:
  Mover(const GridWorld& world, const Eigen::Vector2d& start, const Eigen::Vector2d& goal, const Footprint& footprint,
        double speed, double drift, unsigned seed);

  /// Drives on for `dt` seconds; keeps clear of the others by steering to the right and stopping.
  void step(double dt, const std::vector<const Mover*>& others);
  const Pose2& truth() const { return truth_; }
  const Pose2& odometry() const { return odometry_; }
  Twist2 twist() const { return twist_; }
  double travel() const { return travel_; }
  test::Body body() const { return {footprint_, truth_, std::abs(twist_.speed) > 0.1}; }
  const Footprint& footprint() const { return footprint_; }

 private:
  const GridWorld* world_;
  GoalField field_;
  Footprint footprint_;
  double top_speed_, drift_;
  std::mt19937 random_;
  Pose2 truth_, odometry_;
  Twist2 twist_;
  double travel_ = 0.0;  // [m]
};

/// What became of one encounter, as robot 0 knows robot 1.
struct Outcome {
  bool is_encounter = false;  // mutual sight of a second or more
  bool confirmed = false;
  bool tentative = false;
  bool wrong = false;                    // at any time confirmed and more than 0.3 m or 5 degrees off
  double translation_error = 0.0;        // [m] at confirmation
  double rotation_error = 0.0;           // [rad] at confirmation
  double consistency = 0.0;              // [-] squared error over covariance at confirmation
  double travel = 0.0;                   // [m] of both from first sight to confirmation
  double seconds = 0.0;                  // [s] from first sight to confirmation
  double sight = 0.0;                    // [s] of mutual sight
  double bytes = 0.0;                    // [-] of keyframes and sightings, a robot
  std::vector<double> descriptor_bytes;  // [-]
  std::vector<double> step_seconds;      // [s] processor time of steps that weighed something
};

/// Two robots that meet; a third one that says nothing drives about with one chance in three.
std::optional<Outcome> runEncounter(const GridWorld& world, const StudyOptions& options, unsigned seed);

/// Two robots in different places that hear each other. Each meets another one that says nothing.
std::optional<Outcome> runElsewhere(const GridWorld& world, const StudyOptions& options, unsigned seed);

}  // namespace parley::study

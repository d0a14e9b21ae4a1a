// SPDX-License-Identifier: BSD-3-Clause
// One simulated encounter: robots that drive through a world, see and talk.
#pragma once

#include <optional>
#include <vector>

#include "grid_world.h"
#include "study.h"

namespace parley::study {

/// A robot or a person that drives to goals through free space.
class Mover {
 public:
  Mover(const GridWorld& world, const Eigen::Vector2d& start, const Eigen::Vector2d& goal, const Footprint& footprint,
        double speed, double drift, unsigned seed);

  /// Drives on for `dt` seconds; keeps clear of the others by steering to the right and stopping.
  void step(double dt, const std::vector<const Mover*>& others);
  const Pose2& truth() const { return truth_; }
  RobotState state() const { return {truth_, odometry_, twist_, travel_}; }
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

/// Two robots that meet; a third one that says nothing drives about with one chance in three.
std::optional<Outcome> runEncounter(const GridWorld& world, const StudyOptions& options, unsigned seed);

/// Two robots in different places that hear each other. Each meets another one that says nothing.
std::optional<Outcome> runElsewhere(const GridWorld& world, const StudyOptions& options, unsigned seed);

}  // namespace parley::study

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <optional>

#include "parley_geometry/motion.h"

namespace parley {

/// How poses become velocities.
struct TwistOptions {
  double position_noise = 0.003;    // [m]
  double rotation_noise = 0.002;    // [rad]
  double standing_time = 0.5;       // [s]
  double standing_distance = 0.01;  // [m]
  double standing_angle = 0.01;     // [rad]
  double longest_gap = 0.5;         // [s]

  template <class Visitor>
  void visit(Visitor& v) {
    v.number("position_noise", position_noise, "m", 1e-4, 0.1, "standard deviation of a pose's position from scan to scan");
    v.number("rotation_noise", rotation_noise, "rad", 1e-4, 0.1, "the same of its heading");
    v.number("standing_time", standing_time, "s", 0.0, 5.0, "what has kept its place for so long stands: its twist is zero");
    v.number("standing_distance", standing_distance, "m", 0.0, 0.1, "keeping the place allows this much");
    v.number("standing_angle", standing_angle, "rad", 0.0, 0.1, "and this much of turning");
    v.number("longest_gap", longest_gap, "s", 0.05, 5.0, "after a longer gap between poses the velocity is not known");
  }
};

/// Velocity of a differential drive at its newest pose, from the poses alone: two Kalman filters, along the way and of the
/// heading, whose models are constant velocity with the drive's accelerations as white noise. Quieter than the difference of
/// two poses, and less than a period behind in full braking.
class TwistEstimator {
 public:
  TwistEstimator(const TwistOptions& options, const MotionLimits& limits) : options_(options), limits_(limits) {}

  /// The velocity at `stamp`, which must be later than the last one [s]. nullopt at the first pose and after a gap.
  /// A step that the drive cannot have made is a correction of the poses and does not change the velocity; after two of them
  /// in a row it is not known.
  std::optional<Twist2> add(double stamp, const Pose2& pose);
  void reset() { past_.clear(); }

  int corrections() const { return corrections_; }

 private:
  /// Way and velocity with their covariance.
  struct Axis {
    double way = 0.0, rate = 0.0;
    double way_way = 0.0, way_rate = 0.0, rate_rate = 0.0;

    static Axis started(double noise, double highest_rate);
    void predict(double dt, double acceleration);
    void update(double measured, double noise);
  };
  struct Stamped {
    double stamp;
    Pose2 pose;
  };

  void start(double stamp, const Pose2& pose);
  bool stands() const;

  TwistOptions options_;
  MotionLimits limits_;
  std::deque<Stamped> past_;  // of standing_time, and one before
  Axis along_, heading_;
  double way_ = 0.0, turned_ = 0.0;  // [m] [rad] as measured, since the start
  int corrections_ = 0;              // [-]
};

}  // namespace parley

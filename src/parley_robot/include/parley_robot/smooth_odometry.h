// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "parley_geometry/motion.h"

namespace parley {

/// What a reading of odometry may be off from the motion before it without being a correction.
struct CorrectionOptions {
  double distance = 0.1;       // [m]
  double angle = 0.03;         // [rad]
  double jump_distance = 1.0;  // [m] what is further is no correction
  double jump_angle = 1.0;     // [rad]
};

/// Odometry in a frame of the robot's own that stays smooth where odometry is corrected, as lidar odometry is when it closes a
/// loop. The frame, `local`, is that of odometry until the first correction.
class SmoothOdometry {
 public:
  SmoothOdometry(const CorrectionOptions& options, const MotionLimits& limits) : options_(options), limits_(limits) {}

  /// The reading with its pose in the local frame. A step that neither the twist nor the last step explains, within the
  /// limits' accelerations, and that is no jump is taken as a correction: it moves the frame, and the robot goes on as it did.
  /// Readings that are not finite, out of order or after a gap are passed through.
  Odometry add(const Odometry& reading);

  /// Where the local frame lies in that of odometry.
  const Pose2& odomFromLocal() const { return T_odom_local_; }
  int corrections() const { return corrections_; }

 private:
  bool agree(const Pose2& expected, const Pose2& pose, double dt) const;
  std::optional<Pose2> unlessExplained(const Pose2& pose, double dt) const;

  CorrectionOptions options_;
  MotionLimits limits_;
  Pose2 T_odom_local_;
  std::optional<Odometry> last_;  // in the local frame
  Twist2 last_step_;              // as the last two poses have it
  int corrections_ = 0;           // [-]
};

}  // namespace parley

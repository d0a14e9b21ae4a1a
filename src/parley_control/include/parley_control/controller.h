// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "parley_control/control_options.h"
#include "parley_geometry/footprint.h"
#include "parley_geometry/motion.h"
#include "parley_geometry/scan.h"
#include "parley_geometry/status.h"
#include "parley_geometry/trajectory.h"

namespace parley {

/// What the controller gets to see at one step. A null pointer is an input that has never come.
struct ControlRequest {
  double now = 0.0;                               // [s] robot's clock
  const Odometry* odometry = nullptr;             // newest reading
  const SampledTrajectory* trajectory = nullptr;  // committed, may be empty; odom frame, robot's clock
  double trajectory_stamp = 0.0;                  // [s] when the planner last confirmed or replaced it
  const ObstacleScan* scan = nullptr;             // newest scan
  Pose2 T_odom_scan;                              // base pose at the scan's stamp
  DriveState intent = DriveState::kDriving;       // what the planner says the robot is doing, and why
  std::string intent_reason;
};

struct ControlResult {
  Twist2 twist;                             // to be sent to the drive
  DriveState state = DriveState::kStopped;  // the planner's intent, or what overrules it
  std::string reason;                       // for people; empty while nothing needs saying
  bool emergency = false;                   // the last-moment stop is on: an obstacle is in the braking path
};

/// Trajectory -> twist: flatness feed-forward with feedback (Samson 1993, for either sign of the speed), limits,
/// watchdogs and a last-moment stop. The last stage: whatever fails before it, the robot brakes.
class Controller {
 public:
  /// Throws std::invalid_argument with all problems if an option, a dimension or a limit is out of range.
  Controller(const ControlOptions& options, const Footprint& footprint, const MotionLimits& limits);

  /// One step; call it at a steady rate, 50 Hz by default. Takes any input; time going back starts afresh.
  ControlResult step(const ControlRequest& request);

  /// As after construction: the next step starts from the measured twist.
  void reset();

 private:
  double advanceClock(const ControlRequest& request);
  void locate(const ControlRequest& request, bool odometry_is_good, double dt);
  ControlResult follow(const ControlRequest& request, double dt);
  bool rests(bool reference_stands, const Pose2& error);
  bool lastMomentStop(const ControlRequest& request, const Twist2& intended);
  bool wouldTouch(const ControlRequest& request, const Twist2& intended) const;
  ControlResult brake(const Status<DriveState>& why, const SampledTrajectory* path, double dt);
  ControlResult send(const Twist2& twist, const Status<DriveState>& why);

  ControlOptions options_;
  Footprint footprint_;
  MotionLimits limits_;
  std::optional<double> last_now_;  // [s]
  Twist2 last_command_;
  std::optional<Odometry> present_;      // pose and twist now
  double last_odometry_stamp_ = 0.0;     // [s]
  bool resting_ = false;                 // on a standing reference, within the tolerances
  std::optional<double> blocked_until_;  // [s] the last-moment stop is on at least until then
};

}  // namespace parley

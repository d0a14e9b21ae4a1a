// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "carmen_log.h"
#include "study.h"

namespace parley::study {

/// A stretch of a log: scans first to last, driven forwards or back.
struct Stretch {
  int first = 0, last = 0;  // [-]
  int meeting = 0;          // [-] the scan where the other robot is met
  bool backwards = false;
};

/// Where the log's robot was, with the times at which a robot of ours would be there.
class LogDrive {
 public:
  /// At time 0 the robot is `lead` [s] before the scan of the meeting, or at the end of the stretch if that is nearer. `log`
  /// must outlive it.
  LogDrive(const CarmenLog& log, const Stretch& stretch, double speed, double lead);

  /// Drives on; turns back the way it came while `back_off`. Either takes a second to come about.
  void step(double dt, bool back_off);

  Pose2 truth() const { return at(clock_).pose; }
  Twist2 twist() const;
  double travel() const { return travel_; }
  /// The log's scans before and after this place, the nearer one first.
  std::vector<const LogScan*> scans() const;
  /// The scan that the robot passed in the last step, if any.
  const LogScan* passed() const;

 private:
  struct Knot {
    Pose2 pose;          // T_map_base
    double scan = 0.0;   // [-] the log's scan, and the part of the way to the next
    double time = 0.0;   // [s]
    double speed = 0.0;  // [m/s]
  };

  void addKnots(const Stretch& stretch);
  void setTimes(double speed);
  Knot at(double time) const;

  const CarmenLog* log_;
  std::vector<Knot> knots_;
  double clock_ = 0.0;              // [s]
  double rate_ = 1.0, pace_ = 1.0;  // [-] of the clock, wanted and as it was in the last step
  double travel_ = 0.0;             // [m]
  double last_scan_ = 0.0;          // [-] before the last step
};

}  // namespace parley::study

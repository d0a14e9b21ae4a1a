// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <optional>

#include "parley_geometry/pose2.h"

namespace parley {

/// Where a robot was at a time, by its odometry.
struct TimedPose {
  double stamp = 0.0;      // [s]
  Pose2 pose;              // T_odom_base
  double speed = 0.0;      // [m/s] along x of base_link; used where has_speed
  double turn_rate = 0.0;  // [rad/s]
  bool has_speed = false;
};

struct MotionAt {
  Pose2 pose;                                          // T_odom_base
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  // [m/s] odom frame
  double deviation = 0.0;                              // [m] error that the gap between the readings allows
};

/// The last seconds of a robot's motion from readings that come rarely, late or twice.
class MotionHistory {
 public:
  explicit MotionHistory(std::size_t capacity = 400) : capacity_(capacity) {}

  /// Readings may come in any order; one within a millisecond of another is dropped.
  void add(const TimedPose& reading);
  void forgetBefore(double stamp);
  void clear() { readings_.clear(); }

  bool empty() const { return readings_.empty(); }
  const TimedPose& latest() const { return readings_.back(); }
  /// nullopt in gaps longer than 1.2 s and more than 0.3 s past the newest reading.
  std::optional<MotionAt> at(double time) const;
  /// Length of the way between two times, as far as it is remembered. [m]
  double travel(double from, double to) const;

 private:
  Eigen::Vector2d velocityAt(long index) const;

  std::size_t capacity_;
  std::deque<TimedPose> readings_;
};

}  // namespace parley

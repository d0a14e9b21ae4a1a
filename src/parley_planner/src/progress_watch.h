// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace parley {

/// Notices that a robot which should get on stays where it is.
class ProgressWatch {
 public:
  explicit ProgressWatch(double stuck_time) : stuck_time_(stuck_time) {}

  void reset() {
    since_ = -1.0;
    level_ = 0;
  }
  /// How hard to try: 0 normally, one more for each `stuck_time` [s] within `kNear` of one place. Having got stuck, it takes
  /// `kAway` to be normal again: a measure that helped is kept until it has led out.
  int update(const Eigen::Vector2d& position, double now) {
    const double moved = (position - place_).norm();
    if (since_ < 0.0 || now < since_ || moved > (level_ > 0 ? kAway : kNear)) {
      place_ = position;
      since_ = now;
      level_ = 0;
    }
    const int stuck = static_cast<int>((now - since_) / stuck_time_);
    level_ = stuck > level_ ? stuck : level_;
    return level_;
  }
  int level() const { return level_; }

  static constexpr double kNear = 0.4;  // [m]
  static constexpr double kAway = 1.0;  // [m]

 private:
  double stuck_time_;
  Eigen::Vector2d place_ = Eigen::Vector2d::Zero();
  double since_ = -1.0;  // [s]
  int level_ = 0;
};

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "parley_sim/random_stream.h"

namespace parley::sim {

/// Roll and pitch of a robot on a floor that is not quite even: smooth, small, and different for each robot.
class Attitude {
 public:
  struct Angles {
    double roll = 0.0;   // [rad]
    double pitch = 0.0;  // [rad]
  };

  /// Level for ever.
  Attitude() = default;
  /// Sways by `amplitude` [rad] at most.
  Attitude(double amplitude, RandomStream stream);

  Angles at(double time) const;

 private:
  double sway(const std::array<double, 2>& phases, double time) const;

  double amplitude_ = 0.0;
  std::array<double, 2> roll_phases_{};   // [rad]
  std::array<double, 2> pitch_phases_{};  // [rad]
};

}  // namespace parley::sim

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

namespace parley {

/// The distance that the footprint keeps from obstacles: more the faster. One model for generator and validator.
struct Margins {
  double creeping = 0.03;    // [m] at rest
  double per_speed = 0.04;   // [s] more per m/s
  double creep_speed = 0.2;  // [m/s] that is driven wherever the creeping margin is kept

  double at(double speed) const { return creeping + per_speed * std::max(0.0, std::abs(speed) - creep_speed); }
  /// The highest speed that a clearance [m] allows; 0 if it is less than the creeping margin.
  double speedFor(double clearance) const {
    if (clearance < creeping) return 0.0;
    return creep_speed + (per_speed > 0.0 ? (clearance - creeping) / per_speed : 1e3);
  }
};

}  // namespace parley

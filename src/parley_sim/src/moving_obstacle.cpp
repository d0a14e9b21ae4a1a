// SPDX-License-Identifier: BSD-3-Clause
#include "parley_sim/moving_obstacle.h"

#include <cmath>

namespace parley::sim {

MovingObstacle::MovingObstacle(const MovingObstacleSpec& spec) : spec_(spec) {
  for (std::size_t i = 1; i < spec.path.size(); ++i) length_ += (spec.path[i] - spec.path[i - 1]).norm();
}

Disc MovingObstacle::at(double time) const {
  if (length_ == 0.0) return {spec_.path.front(), spec_.radius};
  const double gone = std::fmod(spec_.speed * time, 2.0 * length_);
  double rest = gone <= length_ ? gone : 2.0 * length_ - gone;
  for (std::size_t i = 1; i < spec_.path.size(); ++i) {
    const Eigen::Vector2d leg = spec_.path[i] - spec_.path[i - 1];
    const double leg_length = leg.norm();
    if (rest <= leg_length && leg_length > 0.0) return {spec_.path[i - 1] + rest / leg_length * leg, spec_.radius};
    rest -= leg_length;
  }
  return {spec_.path.back(), spec_.radius};
}

}  // namespace parley::sim

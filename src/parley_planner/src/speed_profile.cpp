// SPDX-License-Identifier: BSD-3-Clause
#include "speed_profile.h"

#include <algorithm>
#include <cmath>

namespace parley {

SpeedProfile::SpeedProfile(const ReferencePath& path, const MotionLimits& limits)
    : arc_lengths_(path.arcLengths()), stop_(path.length()), braking_(limits.acceleration) {
  const std::size_t n = arc_lengths_.size();
  std::vector<double> curvatures(n);
  for (std::size_t i = 0; i < n; ++i) curvatures[i] = path.at(arc_lengths_[i]).curvature;
  bounds_.assign(n, limits.speed);
  for (std::size_t i = 0; i < n; ++i) {
    const double curvature = std::abs(curvatures[i]);
    if (curvature * limits.speed > limits.turn_rate) lower(i, limits.turn_rate / curvature);
    if (i + 1 == n) continue;
    // d(omega)/dt = v^2 d(kappa)/ds where the speed is constant.
    const double change = std::abs(curvatures[i + 1] - curvatures[i]) / (arc_lengths_[i + 1] - arc_lengths_[i]);
    if (change * limits.speed * limits.speed > limits.turn_acceleration) {
      lower(i, std::sqrt(limits.turn_acceleration / change));
      lower(i + 1, std::sqrt(limits.turn_acceleration / change));
    }
  }
}

void SpeedProfile::lower(std::size_t i, double speed) { bounds_[i] = std::min(bounds_[i], std::max(0.0, speed)); }

void SpeedProfile::lowerBetween(double from, double to, double speed) {
  for (std::size_t i = 0; i < bounds_.size(); ++i) {
    if (arc_lengths_[i] >= from && arc_lengths_[i] <= to) lower(i, speed);
  }
}

void SpeedProfile::stopAt(double s) { stop_ = std::min(stop_, std::max(0.0, s)); }

void SpeedProfile::spread() {
  squares_.resize(bounds_.size());
  for (std::size_t k = bounds_.size(); k-- > 0;) {
    squares_[k] = bounds_[k] * bounds_[k];
    if (k + 1 < bounds_.size()) {
      squares_[k] = std::min(squares_[k], squares_[k + 1] + 2.0 * braking_ * (arc_lengths_[k + 1] - arc_lengths_[k]));
    }
  }
}

double SpeedProfile::at(double s) const {
  const double to_stop = stop_ - s;
  if (to_stop <= 0.0) return 0.0;
  const auto after = std::upper_bound(arc_lengths_.begin() + 1, arc_lengths_.end() - 1, s);
  const auto i = static_cast<std::size_t>(after - arc_lengths_.begin()) - 1;
  const double f = std::clamp((s - arc_lengths_[i]) / (arc_lengths_[i + 1] - arc_lengths_[i]), 0.0, 1.0);
  return std::sqrt(std::min(squares_[i] + f * (squares_[i + 1] - squares_[i]), 2.0 * braking_ * to_stop));
}

}  // namespace parley

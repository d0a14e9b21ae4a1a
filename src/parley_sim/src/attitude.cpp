// SPDX-License-Identifier: BSD-3-Clause
#include "parley_sim/attitude.h"

#include <cmath>

#include "parley_geometry/angles.h"

namespace parley::sim {
namespace {

constexpr std::array<double, 2> kFrequencies{0.31, 0.83};  // [Hz] slow enough for a suspension, and never in step
constexpr std::array<double, 2> kShares{0.6, 0.4};         // [-] of the amplitude

}  // namespace

Attitude::Attitude(double amplitude, RandomStream stream) : amplitude_(amplitude) {
  for (double& phase : roll_phases_) phase = stream.uniform(0.0, 2.0 * kPi);
  for (double& phase : pitch_phases_) phase = stream.uniform(0.0, 2.0 * kPi);
}

double Attitude::sway(const std::array<double, 2>& phases, double time) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < phases.size(); ++i) {
    sum += kShares[i] * std::sin(2.0 * kPi * kFrequencies[i] * time + phases[i]);
  }
  return amplitude_ * sum;
}

Attitude::Angles Attitude::at(double time) const { return {sway(roll_phases_, time), sway(pitch_phases_, time)}; }

}  // namespace parley::sim

// SPDX-License-Identifier: BSD-3-Clause
#include "binned_scan.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "parley_geometry/angles.h"

namespace parley {
namespace {

constexpr float kFree = std::numeric_limits<float>::infinity();
constexpr double kTie = 1e-6;  // [bins] lidars like to put beams exactly on a bin's edge: rounding must not decide there

}  // namespace

BearingBins::BearingBins(int count) : count_(count), width_(2.0 * kPi / count) {}

int BearingBins::of(double bearing) const {
  const int bin = static_cast<int>(std::floor((bearing + kPi) / width_ + kTie));
  return std::clamp(wrap(bin), 0, count_ - 1);
}

BinSpan binsOfBeam(const BearingBins& bins, double bearing, double beam_width) {
  const double width = beam_width / bins.width();
  const double lower = (bearing + kPi) / bins.width() - 0.5 * width - 0.5;
  const int inside = static_cast<int>(std::floor((bearing + kPi) / bins.width() + kTie));
  const int first = std::min(inside, static_cast<int>(std::ceil(lower + kTie)));
  const int last = std::max(inside, static_cast<int>(std::ceil(lower + width + kTie)) - 1);
  const int count = std::min(last - first + 1, bins.count());
  return {std::clamp(bins.wrap(first), 0, bins.count() - 1), count};
}

BinnedScan::BinnedScan(int bins)
    : ranges(static_cast<std::size_t>(bins), std::numeric_limits<float>::quiet_NaN()),
      next_ranges(static_cast<std::size_t>(bins), kFree),
      beams(static_cast<std::size_t>(bins), -1) {}

void BinnedScan::addFree(int bin) {
  float& range = ranges[static_cast<std::size_t>(bin)];
  if (std::isnan(range)) range = kFree;
}

void BinnedScan::addHit(int bin, float range, int beam) {
  const auto i = static_cast<std::size_t>(bin);
  if (ranges[i] <= range) {
    next_ranges[i] = std::min(next_ranges[i], range);
    return;
  }
  if (beams[i] >= 0) next_ranges[i] = ranges[i];
  ranges[i] = range;
  beams[i] = beam;
}

}  // namespace parley

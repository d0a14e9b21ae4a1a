// SPDX-License-Identifier: BSD-3-Clause
#include "bin_predictor.h"

#include <algorithm>
#include <cstdlib>

namespace parley {
namespace {

constexpr std::int64_t kUnit = 1 << 22;  // [-] inverse of a code of one
constexpr int kBreak = 12;               // [-] a larger error is an edge, where another surface begins

struct Line {
  std::array<int, 6> weights;  // [-] of the inverses, newest first
  int divisor;                 // [-]
};

/// Least squares lines through one to six equidistant values, carried on by one step.
constexpr std::array<Line, 6> kLines{{{{1, 0, 0, 0, 0, 0}, 1},
                                      {{3, -1, 0, 0, 0, 0}, 2},  // half the slope: two noisy values make a poor line
                                      {{4, 1, -2, 0, 0, 0}, 3},
                                      {{2, 1, 0, -1, 0, 0}, 2},
                                      {{8, 5, 2, -1, -4, 0}, 10},
                                      {{10, 7, 4, 1, -2, -5}, 15}}};

}  // namespace

int BinPredictor::predicted() const {
  const Line& line = kLines[static_cast<std::size_t>(count_ - 1)];
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count_); ++i) sum += line.weights[i] * inverse_[i];
  const std::int64_t inverse = std::max<std::int64_t>(sum / line.divisor, 1);
  return static_cast<int>(std::clamp<std::int64_t>((kUnit + inverse / 2) / inverse, 1, 254));
}

void BinPredictor::begin(int code) {
  inverse_[0] = kUnit / code;
  count_ = 1;
  roughness_ = 1;
}

void BinPredictor::add(int code, int error) {
  if (std::abs(error) > kBreak) {
    begin(code);
    return;
  }
  for (std::size_t i = kMost - 1; i > 0; --i) inverse_[i] = inverse_[i - 1];
  inverse_[0] = kUnit / code;
  count_ = std::min(count_ + 1, kMost);
  roughness_ = std::abs(error) <= 1 ? 0 : std::abs(error) <= 4 ? 1 : 2;
}

}  // namespace parley

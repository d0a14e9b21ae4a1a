// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

namespace parley {

/// Lets through at most burst + rate * T in any T seconds.
class TokenBucket {
 public:
  TokenBucket(double rate, double burst) : rate_(rate), burst_(burst), level_(burst) {}

  /// What may be spent at `now` [s]. Time that goes back fills nothing.
  double level(double now) {
    if (started_ && now > time_) level_ = std::min(burst_, level_ + rate_ * (now - time_));
    started_ = true;
    time_ = now;
    return level_;
  }
  void spend(double amount) { level_ -= amount; }

 private:
  double rate_;        // [1/s]
  double burst_;       // [-]
  double level_;       // [-]
  double time_ = 0.0;  // [s] of the last look
  bool started_ = false;
};

}  // namespace parley

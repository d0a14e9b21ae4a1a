// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace parley {

/// Says when something that runs at a rate is due; catches up without bursts after a pause.
class Periodic {
 public:
  explicit Periodic(double rate) : period_(1.0 / rate) {}

  bool due(double now) {
    if (now + 1e-9 < next_ && now >= next_ - 2.0 * period_) return false;
    next_ = (now - next_ < period_) ? next_ + period_ : now + period_;
    return true;
  }

 private:
  double period_;       // [s]
  double next_ = -1e9;  // [s]
};

}  // namespace parley

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

/// Says when to plan: at once when there is a new scan, so that nothing seen has to wait for a timer's turn, but not much
/// more often than the rate; and at about the rate when no scan comes.
class PlanTrigger {
 public:
  explicit PlanTrigger(double rate) : period_(1.0 / rate) {}

  bool due(double now, bool new_scan) {
    const double waited = now - last_;
    const bool early = waited >= 0.0 && waited + 1e-9 < (new_scan ? 0.5 : 1.2) * period_;
    if (early) return false;
    last_ = now;
    return true;
  }

 private:
  double period_;       // [s]
  double last_ = -1e9;  // [s]
};

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <ostream>

#include "parley_sim/fleet_runner.h"

namespace parley::sim {

/// Says how far a run is: on a terminal one line that is written over, elsewhere a line every few simulated seconds.
class Progress {
 public:
  Progress(std::ostream& stream, bool terminal);

  void note(const FleetRunner& runner);
  /// Leaves the line.
  void finish();

 private:
  std::ostream& stream_;
  bool terminal_;
  double next_ = 0.0;  // [s] simulated
  bool line_open_ = false;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace parley::sim

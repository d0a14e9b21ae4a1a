// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fstream>
#include <string>

#include "parley_sim/fleet_runner.h"

namespace parley::sim {

/// Writes every robot's true motion as CSV, ten times a simulated second.
class Trace {
 public:
  /// Throws InputError if the file cannot be written.
  explicit Trace(const std::string& file);

  void note(const FleetRunner& runner);

 private:
  std::ofstream stream_;
  long calls_ = 0;
};

}  // namespace parley::sim

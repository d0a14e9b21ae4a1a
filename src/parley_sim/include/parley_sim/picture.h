// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "parley_sim/fleet_runner.h"

namespace parley::sim {

/// Collects where the robots went and draws it on the map.
class Picture {
 public:
  void note(const FleetRunner& runner);

  /// Throws InputError if the file cannot be written.
  void write(const std::string& file, const FleetRunner& runner) const;

 private:
  std::vector<std::vector<Eigen::Vector2d>> tracks_;                    // [m] per robot
  std::vector<int> escapes_;                                            // [-] seen so far, per robot
  std::vector<std::pair<std::size_t, Eigen::Vector2d>> escape_points_;  // robot, [m]
  long calls_ = 0;
};

}  // namespace parley::sim

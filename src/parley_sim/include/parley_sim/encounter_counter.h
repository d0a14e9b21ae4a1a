// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "parley_sim/contacts.h"
#include "parley_sim/scenario.h"

namespace parley::sim {

/// Two robots that had each other within lidar range and in sight for a second or more.
struct Encounter {
  std::size_t first = 0;
  std::size_t second = 0;
  double start = 0.0;                                  // [s] when they came into sight
  double end = 0.0;                                    // [s] five seconds after they last saw each other
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // [m] between them when the second was over
};

/// Finds the encounters of a run. One ends when the two have not seen each other for five seconds.
class EncounterCounter {
 public:
  EncounterCounter(const Scenario& scenario, const World& world);

  /// To be called at a steady pace.
  void observe(const Snapshot& snapshot);

  const std::vector<Encounter>& encounters() const { return encounters_; }

 private:
  struct Sight {
    double since = 0.0;         // [s] start of the sight without a gap
    double last = -1e9;         // [s] last time in sight
    double gone = -1e9;         // [s] the encounter under way ends here if they do not see each other again
    std::size_t encounter = 0;  // [-] its number
  };

  bool inSight(const Snapshot& snapshot, std::size_t first, std::size_t second) const;
  void note(const Snapshot& snapshot, std::size_t first, std::size_t second, Sight& sight);

  const World* world_;
  std::vector<double> ranges_;  // [m]
  std::map<std::pair<std::size_t, std::size_t>, Sight> sights_;
  double last_observed_ = -1e9;  // [s]
  std::vector<Encounter> encounters_;
};

}  // namespace parley::sim

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "parley_geometry/pose2.h"
#include "parley_sim/encounter_counter.h"

namespace parley::sim {

/// Where a robot believes another one's odom frame to be, and stands by it.
struct PeerBelief {
  std::string peer;
  Pose2 T_odom_peerodom;
};

/// The state of one robot at one instant: what is true and what it believes.
struct BelievedState {
  Pose2 truth;                                       // of base_link, world frame
  Pose2 odometry;                                    // of base_link, its odom frame
  const std::vector<PeerBelief>* beliefs = nullptr;  // confirmed ones
};

struct PoseError {
  double translation = 0.0;  // [m]
  double rotation = 0.0;     // [rad]
};

/// Compares confirmed relative poses of robots with the truth: the place of the other's body as seen from the own.
class LocalizationJudge {
 public:
  explicit LocalizationJudge(const std::vector<std::string>& names);

  /// To be called at a steady pace; null for robots that are not there.
  void observe(double time, const std::vector<std::optional<BelievedState>>& robots, const std::vector<Encounter>& encounters);

  /// At each confirmation.
  const std::vector<PoseError>& errors() const { return errors_; }
  /// For each encounter within which both confirmed the other: from its start until both had. [s]
  std::vector<double> secondsToLocalize() const;
  /// Pairs of which one at any time held a pose for confirmed that was more than 0.3 m or 5 degrees off. [-]
  int falsePairs() const { return static_cast<int>(false_pairs_.size()); }

 private:
  using Pair = std::pair<std::size_t, std::size_t>;

  void judgeBelief(const Pair& pair, const BelievedState& robot, const BelievedState& other, const Pose2& T_odom_peerodom);

  std::map<std::string, std::size_t> indices_;
  std::set<Pair> confirmed_;  // first believes to know second
  std::set<Pair> false_pairs_;
  std::vector<PoseError> errors_;
  std::map<std::size_t, double> localized_;  // [s] by number of the encounter
};

}  // namespace parley::sim

// SPDX-License-Identifier: BSD-3-Clause
#include "parley_sim/localization_judge.h"

#include <algorithm>
#include <cmath>

namespace parley::sim {
namespace {

constexpr double kFalseDistance = 0.3;             // [m]
constexpr double kFalseAngle = 5.0 * kPi / 180.0;  // [rad]

}  // namespace

LocalizationJudge::LocalizationJudge(const std::vector<std::string>& names) {
  for (std::size_t i = 0; i < names.size(); ++i) indices_[names[i]] = i;
}

void LocalizationJudge::judgeBelief(const Pair& pair, const BelievedState& robot, const BelievedState& other,
                                    const Pose2& T_odom_peerodom) {
  const Pose2 believed = robot.odometry.inverse() * (T_odom_peerodom * other.odometry);
  const Pose2 off = (robot.truth.inverse() * other.truth).inverse() * believed;
  const PoseError error{off.position().norm(), std::abs(off.yaw)};
  if (error.translation > kFalseDistance || error.rotation > kFalseAngle)
    false_pairs_.insert(std::minmax(pair.first, pair.second));
  if (confirmed_.insert(pair).second) errors_.push_back(error);
}

void LocalizationJudge::observe(double time, const std::vector<std::optional<BelievedState>>& robots,
                                const std::vector<Encounter>& encounters) {
  std::set<Pair> held;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    if (!robots[i] || !robots[i]->beliefs) continue;
    for (const PeerBelief& belief : *robots[i]->beliefs) {
      const auto peer = indices_.find(belief.peer);
      if (peer == indices_.end() || peer->second == i || !robots[peer->second]) continue;
      held.emplace(i, peer->second);
      judgeBelief({i, peer->second}, *robots[i], *robots[peer->second], belief.T_odom_peerodom);
    }
  }
  confirmed_ = std::move(held);
  for (std::size_t k = 0; k < encounters.size(); ++k) {
    const Encounter& encounter = encounters[k];
    if (time > encounter.end || localized_.count(k)) continue;
    if (confirmed_.count({encounter.first, encounter.second}) && confirmed_.count({encounter.second, encounter.first})) {
      localized_[k] = std::max(0.0, time - encounter.start);
    }
  }
}

std::vector<double> LocalizationJudge::secondsToLocalize() const {
  std::vector<double> seconds;
  for (const auto& [encounter, duration] : localized_) seconds.push_back(duration);
  return seconds;
}

}  // namespace parley::sim

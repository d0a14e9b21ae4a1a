// SPDX-License-Identifier: BSD-3-Clause
#include "hypotheses.h"

#include <algorithm>
#include <cmath>

namespace parley {
namespace {

constexpr double kRangeGate = 0.35;        // [m] both see each other from the same distance
constexpr double kMiddleDepth = 0.25;      // [m] from what faces the lidar to a robot's centre
constexpr double kChordSlack = 0.15;       // [m]
constexpr double kScanPeriod = 0.06;       // [s] scans closer in time than this show the same instant
constexpr int kSupported = 8;              // [-] score from which on no larger time offset is tried
constexpr std::size_t kMostProposals = 3;  // [-] at a time
constexpr double kSearchDistance = 0.3;    // [m]

bool couldBe(const SightedBlob& blob, const Footprint& footprint) {
  const double least = 2.0 * footprint.inscribedRadius(), most = 2.0 * footprint.circumscribedRadius();
  return blob.chord > least - kChordSlack && blob.chord < most + kChordSlack;
}

}  // namespace

bool isAlike(const Pose2& a, const Pose2& b, const Eigen::Vector2d& center, double distance, double turn) {
  const Eigen::Vector3d step = stepBetween(a, b, center);
  return step.head<2>().norm() < distance && std::abs(step.z()) < turn;
}

bool Hypotheses::isKnown(const MeetingPose& pose, const Eigen::Vector2d& center) const {
  return std::any_of(all_.begin(), all_.end(), [&](const Hypothesis& hypothesis) {
    return isAlike(hypothesis.fit.pose.T_odom_peerodom, pose.T_odom_peerodom, center);
  });
}

void Hypotheses::propose(const SightRecord& own_sight, const SightRecord& peer_sight, std::vector<MeetingPose>& found) const {
  for (const SightedBlob& a : own_sight.blobs) {
    for (const SightedBlob& b : peer_sight.blobs) {
      const double range_a = a.position.norm(), range_b = b.position.norm();
      if (std::abs(range_a - range_b) > kRangeGate) continue;
      const double range = 0.5 * (range_a + range_b) + kMiddleDepth;
      const double bearing_a = std::atan2(a.position.y(), a.position.x()), bearing_b = std::atan2(b.position.y(), b.position.x());
      const Pose2 T_scan_peerscan{range * std::cos(bearing_a), range * std::sin(bearing_a), bearing_a + kPi - bearing_b};
      found.push_back(
          {own_sight.T_odom_scan * T_scan_peerscan * peer_sight.T_odom_scan.inverse(), peer_sight.stamp - own_sight.stamp});
    }
  }
}

void Hypotheses::propose(const MeetingSide& own, const MeetingSide& peer, double newest_used) {
  const bool is_supported = !all_.empty() && best().fit.score() >= kSupported;
  const double reach = is_supported ? kScanPeriod : options_.max_time_offset + kScanPeriod;
  std::vector<MeetingPose> found;
  for (auto sight = peer.sights.rbegin(); sight != peer.sights.rend() && sight->stamp > newest_used; ++sight) {
    SightRecord theirs = *sight;
    const auto not_own = [&](const SightedBlob& blob) { return !couldBe(blob, own.footprint); };
    theirs.blobs.erase(std::remove_if(theirs.blobs.begin(), theirs.blobs.end(), not_own), theirs.blobs.end());
    if (theirs.blobs.empty()) continue;
    for (const SightRecord& mine : own.sights) {
      if (std::abs(mine.stamp - theirs.stamp) > reach) continue;
      SightRecord fitting{mine.stamp, mine.T_odom_scan, {}, {}, false, {}};
      for (std::size_t i = 0; i < mine.blobs.size(); ++i) {
        if (couldBe(mine.blobs[i], peer.footprint) && !mine.isOfAnother(i, peer.name)) fitting.blobs.push_back(mine.blobs[i]);
      }
      propose(fitting, theirs, found);
    }
  }
  const auto nearer_in_time = [](const MeetingPose& a, const MeetingPose& b) {
    return std::abs(a.time_offset) < std::abs(b.time_offset);
  };
  std::stable_sort(found.begin(), found.end(), nearer_in_time);
  keepMostPromising(own, peer, found);
}

void Hypotheses::keepMostPromising(const MeetingSide& own, const MeetingSide& peer, const std::vector<MeetingPose>& found) {
  constexpr std::size_t kMostTried = 40;  // [-]
  struct Tried {
    MeetingPose pose;
    int score;
  };
  std::vector<Tried> tried;
  if (own.sights.empty()) return;
  const Eigen::Vector2d here = own.sights.back().T_odom_scan.position();
  for (const MeetingPose& pose : found) {
    const bool is_new = std::none_of(tried.begin(), tried.end(), [&](const Tried& other) {
      return isAlike(other.pose.T_odom_peerodom, pose.T_odom_peerodom, here, 0.2, 0.1);
    });
    if (!is_new || isKnown(pose, here)) continue;
    const SightTerms sights = agreeingSights(own, peer, pose, options_.sight_gate, options_);
    tried.push_back({pose, static_cast<int>(sights.terms.size()) - 4 * sights.contradictions});
    if (tried.size() >= kMostTried) break;
  }
  std::stable_sort(tried.begin(), tried.end(), [](const Tried& a, const Tried& b) { return a.score > b.score; });
  for (std::size_t i = 0; i < std::min(tried.size(), kMostProposals); ++i) {
    if (tried[i].score <= 0) continue;
    Hypothesis hypothesis;
    hypothesis.fit.pose = tried[i].pose;
    all_.push_back(hypothesis);
  }
}

void Hypotheses::suggest(const Pose2& T_odom_peerodom, const Eigen::Vector2d& center, bool from_search) {
  if (!from_search) {
    for (Hypothesis& hypothesis : all_) hypothesis.remembered = false;
  }
  for (Hypothesis& hypothesis : all_) {
    if (!isAlike(hypothesis.fit.pose.T_odom_peerodom, T_odom_peerodom, center, kSearchDistance)) continue;
    hypothesis.surface_matches += from_search ? 1 : 0;
    hypothesis.remembered = hypothesis.remembered || !from_search;
    return;
  }
  Hypothesis hypothesis;
  hypothesis.fit.pose.T_odom_peerodom = T_odom_peerodom;
  hypothesis.surface_matches = from_search ? 1 : 0;
  hypothesis.remembered = !from_search;
  all_.push_back(hypothesis);
}

void Hypotheses::weigh(const MeetingSide& own, const MeetingSide& peer) {
  if (own.sights.empty()) return;
  const Eigen::Vector2d here = own.sights.back().T_odom_scan.position();
  remembered_contradictions_ = 0;
  for (Hypothesis& hypothesis : all_) {
    const MeetingPose before = hypothesis.fit.pose;
    hypothesis.fit = fitSights(own, peer, before, std::nullopt, options_);
    if (!hypothesis.fit.solved) hypothesis.fit.pose = before;
    if (hypothesis.remembered) remembered_contradictions_ = hypothesis.fit.contradictions_in_row;
  }
  const auto better = [](const Hypothesis& a, const Hypothesis& b) {
    return a.fit.score() + a.surface_matches > b.fit.score() + b.surface_matches;
  };
  std::stable_sort(all_.begin(), all_.end(), better);
  std::vector<Hypothesis> kept;
  for (const Hypothesis& hypothesis : all_) {
    const bool is_backed = hypothesis.fit.score() > 0 || hypothesis.surface_matches > 0 || hypothesis.remembered;
    const bool is_twin = std::any_of(kept.begin(), kept.end(), [&](const Hypothesis& other) {
      return isAlike(other.fit.pose.T_odom_peerodom, hypothesis.fit.pose.T_odom_peerodom, here);
    });
    if (hypothesis.fit.contradictions > 2 + hypothesis.fit.own_sights / 4 || !is_backed || is_twin) continue;
    if (kept.size() < static_cast<std::size_t>(options_.max_hypotheses)) kept.push_back(hypothesis);
  }
  all_ = kept;
}

bool Hypotheses::hasRival() const {
  if (all_.size() < 2) return false;
  const double enough = options_.rival_share * best().fit.score();
  return std::any_of(all_.begin() + 1, all_.end(),
                     [&](const Hypothesis& other) { return other.fit.isMutual(2, 1) && other.fit.score() > enough; });
}

}  // namespace parley

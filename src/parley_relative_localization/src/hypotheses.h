// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sight_fit.h"

namespace parley {

/// One way in which the peer could stand, and what speaks for it.
struct Hypothesis {
  SightFit fit;
  int surface_matches = 0;  // [-] global searches that came to it
  bool remembered = false;  // known from before: stays without sightings
};

/// Poses weighed against each other. They come from mutual detections, from global searches and from what is known already.
class Hypotheses {
 public:
  explicit Hypotheses(const RelativeLocalizationOptions& options) : options_(options) {}

  /// Each pair of blobs, one seen by each side at about the same time at about the same range, is a complete pose.
  void propose(const MeetingSide& own, const MeetingSide& peer, double newest_used);
  /// A pose from elsewhere; counted for a hypothesis that is there already.
  void suggest(const Pose2& T_odom_peerodom, const Eigen::Vector2d& center, bool from_search);
  /// Fits all anew to what both sides saw, drops what is contradicted and keeps the best of those alike. Best first.
  void weigh(const MeetingSide& own, const MeetingSide& peer);
  /// Newest own scans that saw through the peer where it is remembered.
  int rememberedContradictions() const { return remembered_contradictions_; }
  void dropBest() { all_.erase(all_.begin()); }
  void replaceBest(const SightFit& fit) { all_.front().fit = fit; }
  void clear() { all_.clear(); }

  const std::vector<Hypothesis>& all() const { return all_; }
  bool empty() const { return all_.empty(); }
  const Hypothesis& best() const { return all_.front(); }
  /// Another pose has that share of the best one's support.
  bool hasRival() const;

 private:
  bool isKnown(const MeetingPose& pose, const Eigen::Vector2d& center) const;
  void propose(const SightRecord& own_sight, const SightRecord& peer_sight, std::vector<MeetingPose>& found) const;
  void keepMostPromising(const MeetingSide& own, const MeetingSide& peer, const std::vector<MeetingPose>& found);

  RelativeLocalizationOptions options_;
  std::vector<Hypothesis> all_;
  int remembered_contradictions_ = 0;  // [-]
};

/// Whether two poses place the peer alike: within `distance` [m] at `center` and `turn` [rad].
bool isAlike(const Pose2& a, const Pose2& b, const Eigen::Vector2d& center, double distance = 0.35, double turn = 0.18);

}  // namespace parley

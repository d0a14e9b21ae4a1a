// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hypotheses.h"
#include "parley_relative_localization/relative_localization.h"
#include "sight_motion.h"
#include "surface_check.h"

namespace parley {

/// This robot's side, as all peers are weighed against it.
struct OwnView {
  MeetingSide side;
  OwnSurfaces surfaces;
  double travel = 0.0;  // [m] since the start
};

/// A pose that is held, with what the odometers said when it was measured.
struct HeldPose {
  PoseEstimate T_odom_peerodom;
  double stamp = 0.0;                          // [s] of the last evidence
  double own_travel = 0.0, peer_travel = 0.0;  // [m]
  int support = 0;                             // [-]
  double time_offset = 0.0;                    // [s]
};

/// Everything known of one peer: what it sent, how it could stand, and how sure that is.
/// Unknown -> candidate (one mutual detection) -> tentative (several in both ways) -> confirmed (see README).
class PeerLocalizer {
 public:
  PeerLocalizer(const RelativeLocalizationOptions& options, std::string name);

  void addMotion(const MotionReport& motion);
  void addSights(const SightReport& report);
  void addKeyframe(int id, double stamp, const Pose2& T_odom_scan, const PolarScan& scan);

  /// Weighs hypotheses if there is something new. `known`: what others' measurements say of the peer's odom frame.
  void weigh(double now, const OwnView& own, const std::optional<Pose2>& known, RelativeLocalizationCounters& counters);
  /// Moves between the states; `blocked` if another peer claims the same place.
  void judge(double now, const OwnView& own, bool blocked, RelativeLocalizationCounters& counters);

  const std::string& name() const { return name_; }
  PoseState state() const { return state_; }
  PeerEstimate estimate(double now, const OwnView& own) const;
  /// Where the peer was `at` a time of the own clock [s] if its best hypothesis is right, with that hypothesis' support;
  /// nullopt without mutual support about then.
  struct Claim {
    Eigen::Vector2d place;  // [m] own odom
    int score = 0;          // [-]
    bool confirmed = false;
  };
  std::optional<Claim> claim(double at) const;
  /// What speaks for its best hypothesis; null without mutual support.
  const SightFit* evidence() const;
  /// So much speaks for a fit, that it is believed against what third robots say.
  bool isBeyondDoubt(const SightFit& fit) const;
  /// The measured pose to hand on, once confirmed.
  std::optional<RelativeEdge> edge(const std::string& own_name, const OwnView& own) const;

  /// For the global search: the peer's surfaces where it lacks a mutual hypothesis; null otherwise.
  std::shared_ptr<const SurfaceMap> surfacesToSearch(const OwnView& own) const;
  double lastSearch() const { return last_search_; }
  void setSearched(double now, const std::optional<Pose2>& found, const OwnView& own);
  double travel() const { return travel_; }
  /// Where the peer was at `stamp` [s] of the own clock if `pose` is right; nullopt if it did not say. [m] own odom
  std::optional<Eigen::Vector2d> placeAt(double stamp, const MeetingPose& pose) const;

 private:
  bool isDue(double now) const;
  SurfaceVerdict checkBest(const OwnView& own, RelativeLocalizationCounters& counters);
  bool isGood(const SightFit& fit) const;
  bool isImprovement(const SightFit& fit, const OwnView& own) const;
  bool isConfirmable(const SightFit& fit) const;
  void hold(PoseState state, const SightFit& fit, const OwnView& own);
  void reconsider(const OwnView& own, bool blocked, RelativeLocalizationCounters& counters);
  PoseEstimate grown(const OwnView& own) const;

  RelativeLocalizationOptions options_;
  std::string name_;
  MeetingSide side_;
  SightMotion sight_motion_;
  std::deque<PlacedScan> keyframes_;
  std::shared_ptr<const SurfaceMap> surfaces_;
  Hypotheses hypotheses_;
  SurfaceVerdict verdict_;  // on the best hypothesis
  PoseState state_ = PoseState::kUnknown;
  std::optional<HeldPose> held_;
  bool changed_ = false;                // something came since the last weighing
  int surface_contradictions_ = 0;      // [-] checks in a row that spoke against the held pose
  double newest_used_ = -1e18;          // [s] sights up to this have been proposed
  double last_weighed_ = -1e18;         // [s]
  double last_search_ = -1e18;          // [s]
  double searched_own_travel_ = -1e18;  // [m]
  int searched_id_ = -1;                // [-] newest keyframe that was searched with
  double travel_ = 0.0;                 // [m]
};

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "parley_geometry/scan.h"
#include "parley_relative_localization/exchange_records.h"
#include "parley_relative_localization/relative_localization_options.h"
#include "parley_relative_localization/scan_descriptor.h"

namespace parley {

/// How far a relative pose is to be trusted. Only confirmed ones make obstacles and maps.
enum class PoseState { kUnknown, kCandidate, kTentative, kConfirmed };

const char* toString(PoseState state);

/// What is known of one peer. With kUnknown only `peer` means anything: "do not know" is a normal answer.
struct PeerEstimate {
  std::string peer;
  PoseState state = PoseState::kUnknown;
  PoseEstimate T_odom_peerodom;
  double age = 0.0;          // [s] since the last evidence for it
  int support = 0;           // [-] sightings and matches that agree with it
  double time_offset = 0.0;  // [s] the peer's clock ahead of what its stamps were converted to
  bool direct = true;        // false if it is known through third robots only
};

/// Numbers for diagnostics.
struct RelativeLocalizationCounters {
  long refused = 0;          // [-] inputs that cannot be
  long refused_peers = 0;    // [-] inputs of peers beyond max_peers
  long global_searches = 0;  // [-]
  long matches = 0;          // [-] scan matches of any kind
  long demotions = 0;        // [-] confirmed poses that were contradicted
};

/// Finds where other robots stand in this robot's odom frame from scans, odometries and sightings of both sides.
/// Same inputs in the same order, same results, bit for bit. Memory and work are bounded by the options.
class RelativeLocalization {
 public:
  /// Throws std::invalid_argument with all problems if an option, the name or the footprint cannot be.
  RelativeLocalization(const RelativeLocalizationOptions& options, std::string name, const Footprint& footprint);
  ~RelativeLocalization();
  RelativeLocalization(RelativeLocalization&&) noexcept;
  RelativeLocalization& operator=(RelativeLocalization&&) noexcept;

  /// The lidar stage's result and where the robot was at its stamp. A scan not newer than the last one is refused.
  void addOwnScan(const Pose2& T_odom_base, const ObstacleScan& scan);

  void addPeerMotion(const std::string& peer, const MotionReport& motion);
  void addPeerSights(const std::string& peer, const SightReport& report);
  void addPeerKeyframe(const std::string& peer, const Keyframe& keyframe);
  /// A pose that two other robots measured, or the peer's view of this robot.
  void addEdge(const RelativeEdge& edge);

  /// Weighs what came since the last step. Estimates are sorted by name.
  std::vector<PeerEstimate> step(double now);

  /// What a peer without a confirmed pose should be sent, newest first.
  std::vector<Keyframe> keyframes() const;
  /// Scans after `since` in which there were blobs, at most `max_reports` spread over that time, oldest first; to be sent a few
  /// times a second while a peer is near. Told of the last second each time, a peer that hears little hears enough.
  std::vector<SightReport> sights(double since) const;
  /// Poses that this robot measured itself and holds for confirmed.
  std::vector<RelativeEdge> edges() const;
  /// This robot's way since its start by its odometry, for its beacons. [m]
  double travel() const;
  RelativeLocalizationCounters counters() const;

  /// For a peer that has started anew: its odometry has another origin.
  void forget(const std::string& peer);
  /// For when own odometry jumped or time went back.
  void reset();

 private:
  class Core;
  std::unique_ptr<Core> core_;
};

}  // namespace parley

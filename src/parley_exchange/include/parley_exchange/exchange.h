// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "parley_exchange/exchange_options.h"
#include "parley_exchange/exchange_output.h"
#include "parley_exchange/peer_state.h"
#include "parley_exchange/team_key.h"

namespace parley {

/// Who a robot is on the radio.
struct ExchangeIdentity {
  std::string name;        // 1 to 24 printable characters, one of its own in the team
  std::uint32_t boot = 1;  // from nextBoot(): higher at each start
  TeamKey key{};
  Footprint footprint;
  MotionLimits limits;
};

/// A piece of an obstacle's outline that this robot's own sensing knows, in its odom frame.
struct OwnContour {
  std::int64_t key = 0;  // a name that stays, such as map tile and piece
  Polygon polygon;       // [m]
  bool closed = false;
  bool hole = false;
  double seen = 0.0;  // [s] when own sensing last confirmed it
};

/// Where a peer's odom frame is believed to be in this robot's.
struct PeerPose {
  PoseEstimate T_odom_peer;  // from the peer's odom frame into the own one
  int support = 0;           // [-] matches behind it
  EdgeState state = EdgeState::kTentative;
  bool measured = true;  // by this robot itself; what follows from others' measurements is not told again
};

/// Decides what to send to whom and when, and keeps what others sent. Plain data in and out, time is an argument, and
/// the same calls give the same bytes. Nothing that others send throws, nor makes it grow beyond the options' limits.
class Exchange {
 public:
  /// Throws std::invalid_argument with all problems if options or identity are not usable.
  Exchange(const ExchangeOptions& options, const ExchangeIdentity& identity);
  ~Exchange();
  Exchange(Exchange&&) noexcept;
  Exchange& operator=(Exchange&&) noexcept;

  // What this robot has to tell. Numbers that are not finite or out of range are refused with false, and counted.

  /// At the odometry's rate; drops an anchor every few metres.
  bool setOdometry(const Odometry& odometry, DriveState state);
  bool setTrajectory(const SampledTrajectory& trajectory, DriveState state);
  /// Where this robot means to go; sent with its trajectory, at once when right of way changes.
  bool setIntent(const IntentMessage& intent);
  /// All that hold now; an empty list releases all.
  bool setConflicts(const std::vector<Conflict>& conflicts);
  /// Scans that saw something, the newest first, with their ages at `now`. The newest goes out once, and where much is lost
  /// to robots whose pose is not known, those before it again.
  bool setObservations(const std::vector<ObservationMessage>& scans, double now);
  /// Replaces the keyframe before the eighth last; the id that peers see.
  std::optional<std::uint32_t> publishKeyframe(const Bytes& descriptor, const Pose2& T_odom_base, double stamp, double now);
  /// All contours known now. Those that changed are published, those that are gone withdrawn, and those that a confirmed
  /// peer has published already are endorsed.
  void publishContours(const std::vector<OwnContour>& contours, double now);
  /// The estimate decides what is endorsed and who needs keyframes. Measured ones go out as edges between the anchors
  /// nearest to both robots, once both are known.
  bool setPeerPose(RobotId peer, const PeerPose& pose, double now);
  /// Own sensing saw through another robot's contour.
  bool contest(const ContourName& contour, double now);
  /// Odometry was corrected: where an anchor is now. Contours stay as they are.
  bool moveAnchor(std::uint32_t id, const Pose2& T_odom_anchor, double now);

  // The radio.

  void addPacket(const Bytes& datagram, double now);
  /// At 20 Hz or more.
  ExchangeOutput step(double now);

  // What is known.

  RobotId id() const;
  std::vector<PeerState> peers(double now) const;
  std::optional<PeerTrajectory> trajectoryOf(RobotId peer, double now) const;
  std::optional<PeerIntent> intentOf(RobotId peer) const;
  std::optional<PeerConflicts> conflictsOf(RobotId peer) const;
  /// The last 16 scans that the peer told of, each once, in the order in which they came.
  std::vector<PeerObservations> observationsOf(RobotId peer, double now) const;
  /// Robots whose maps are held, this one included if it has published anything.
  std::vector<RobotId> origins() const;
  /// Counts changes of what is held of an origin's map, so that one looks only when there is something new. [-]
  int mapRevision(RobotId origin) const;
  std::vector<SharedContour> contoursOf(RobotId origin) const;
  std::vector<SharedAnchor> anchorsOf(RobotId origin) const;
  std::vector<SharedEdge> edges() const;
  std::vector<SharedKeyframe> keyframesOf(RobotId origin, double now) const;
  const ExchangeCounters& counters() const;
  /// What is held, for a watch on memory. [byte]
  std::size_t storedBytes() const;

 private:
  class Core;
  std::unique_ptr<Core> core_;
};

}  // namespace parley

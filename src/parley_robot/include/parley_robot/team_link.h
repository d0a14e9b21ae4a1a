// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "parley_exchange/exchange.h"
#include "parley_lidar/lidar_stage.h"
#include "parley_planner/peer_motion.h"
#include "parley_relative_localization/relative_localization.h"
#include "parley_robot/contour_keys.h"
#include "parley_robot/packet.h"
#include "parley_topology/topology.h"

namespace parley {

/// A teammate as far as it is known.
struct Teammate {
  RobotId id = 0;
  std::string name;  // empty until a beacon came
  PeerEstimate estimate;
};

/// How others' outlines over the own map have changed.
struct MapChanges {
  std::vector<LayerUpdate> drawn;
  std::vector<std::string> removed;  // origins
  std::vector<Refuted> refuted;      // outlines that somebody saw through: what own sensing held there may be gone
};

/// What the team knows, and what it is told: couples the radio with relative localization, and both with the map. Times are
/// of this robot's clock.
class TeamLink {
 public:
  /// Without `share_maps` outlines are neither told nor used. Throws std::invalid_argument if options cannot be.
  TeamLink(const ExchangeOptions& exchange, const RelativeLocalizationOptions& relative_localization,
           const ExchangeIdentity& identity, bool share_maps);

  void addPacket(const Packet& packet, double now);
  /// A scan of this robot and where it was made: looked at for teammates, and told where they may recognise it.
  void addScan(const Pose2& T_odom_base, const ObstacleScan& scan, double now);
  /// Weighs all that came; to be called once for each scan.
  void locate(double now);

  /// Whether it is time to tell the map again.
  bool mapIsDue(double now) const;
  /// Tells what own sensing knows of obstacles, and which of others' outlines it has seen through.
  void tellMap(const std::vector<Contour>& contours, const std::vector<SeenThrough>& seen_through, double now);
  /// What others know, to be laid over the map where their frames are known well enough, and what is no longer known, to be
  /// taken away. Each change is said once.
  MapChanges drawMaps(const Pose2& T_odom_base, double now);
  /// Bodies whose place is known well enough to keep their returns off the map.
  std::vector<KnownTeammate> bodies(double now) const;

  /// Those whose place is known well enough, with what they said they will do.
  std::vector<PeerMotion> motions(double now) const;
  /// Whether the radio works and every robot that is near enough to be heard is where it says: nobody comes unexpectedly.
  bool isTeamKnown(double now) const;
  /// Where this robot means to go, to be told.
  void setIntent(const Intent& intent);
  /// The number by which teammates know this robot.
  RobotId id() const { return exchange_.id(); }

  /// What to broadcast; call it at the control rate. `trajectory` may be empty.
  std::vector<Packet> step(double now, const Odometry& odometry, const SampledTrajectory& trajectory, DriveState state);

  /// All that have been heard of, by their number.
  const std::map<RobotId, Teammate>& teammates() const { return teammates_; }
  const Exchange& exchange() const { return exchange_; }
  RelativeLocalizationCounters localizationCounters() const { return localization_.counters(); }

 private:
  using ContourVersion = std::pair<std::uint32_t, std::uint32_t>;  // id and sequence

  /// What of a peer has been passed on to relative localization.
  struct Heard {
    double motion = -1e9;             // [s] stamp of the newest
    double sights = -1e9;             // [s] those that came until then
    std::uint32_t next_keyframe = 0;  // [-] id
  };
  /// What of an origin's map is drawn.
  struct Drawn {
    int revision = -1;  // [-] nothing is
    Pose2 T_odom_peer;
    bool hard = false;
    double at = -1e9;  // [s]
    std::set<ContourVersion> contested;
  };
  struct AnchorPlace {
    Pose2 pose;           // T_odom_anchor, odom frame of its origin
    double travel = 0.0;  // [m] way to it along the anchors
  };

  void hear(const PeerState& peer, double now);
  void hearEdges();
  double travelOf(RobotId origin, const Pose2& T_odom_base) const;
  std::optional<AnchorPlace> anchorPlace(RobotId origin, std::uint32_t id) const;
  std::optional<bool> hardness(const Teammate& teammate, const Pose2& T_odom_base, bool was_hard) const;
  LayerUpdate layerOf(RobotId origin, double now);
  void contest(const std::vector<SeenThrough>& seen_through, double now);

  bool share_maps_;
  Exchange exchange_;
  RelativeLocalization localization_;
  std::map<RobotId, Teammate> teammates_;
  std::map<RobotId, Heard> heard_;
  std::map<std::pair<RobotId, RobotId>, double> edges_;  // [s] when those passed on were written
  std::map<RobotId, Drawn> drawn_;
  ContourKeys contour_keys_;
  std::map<std::int64_t, Contour> told_contours_;  // by key
  std::vector<Refuted> refuted_;                   // since maps were drawn last
  std::set<RobotId> told_poses_;                   // whose pose has been given to the exchange
  std::optional<Eigen::Vector2d> told_keyframe_;   // [m] where the last one was
  double told_map_at_ = -1e9;                      // [s]
};

}  // namespace parley

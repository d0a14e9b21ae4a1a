// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>

#include "digest_writer.h"
#include "own_edges.h"
#include "own_map.h"
#include "pace.h"
#include "parley_exchange/exchange.h"
#include "peer.h"
#include "record_selector.h"

namespace parley {

/// The parts of an exchange and how they work together: exchange_core.cpp receives, exchange_send.cpp sends.
class Exchange::Core {
 public:
  Core(const ExchangeOptions& options, const ExchangeIdentity& identity);

  void addPacket(const Bytes& datagram, double now);
  ExchangeOutput step(double now);

  bool setPeerPose(RobotId peer, const PeerPose& pose, double now);
  bool contest(const ContourName& contour, double now);
  void publishContours(const std::vector<OwnContour>& contours, double now);
  /// Contests and endorsements may have changed.
  void updateReferences();
  int mapRevision(RobotId origin) const;
  LogName ownMapName() const { return {self, RecordStream::kMap}; }
  LogName ownKeyframesName() const { return {self, RecordStream::kKeyframes}; }

  const ExchangeOptions options;
  const ExchangeIdentity identity;
  const RobotId self;

  // What others said.
  Receiver receiver;
  PeerMap peers;
  RecordStore store;
  References references;
  std::map<RobotId, PeerPose> poses;

  // What this robot has to say.
  OwnLog map_log;
  OwnLog keyframe_log;
  OwnMap map;
  std::optional<Odometry> odometry;
  DriveState state = DriveState::kStopped;
  DriveState trajectory_state = DriveState::kStopped;
  Pace pace;
  std::optional<IntentMessage> intent;    // goes with trajectories
  std::vector<ObservationMessage> scans;  // the newest first
  double scans_at = -1e9;                 // [s] when they had their ages

  ExchangeCounters counters;

 private:
  Peer* admit(const FrameHeader& header, double now);
  void takeDigest(Peer& peer, const PacketContent& content);
  void takeRecords(Peer& peer, const RecordGroup& group, double now);
  void takeRecord(Peer& peer, const LogName& name, std::uint32_t epoch, Record record, double now);
  void tellContested(const std::vector<References::Target>& changed);
  void publishEdge(RobotId peer, const PeerPose& pose, double now);
  std::optional<SharedAnchor> anchorNear(RobotId origin, const Eigen::Vector2d& position) const;

  void forgetOld(double now);
  void warnOfNamesakes(double now);
  int neighbourCount(double now) const;
  double beaconRate(double now) const;
  std::size_t scansToTell(double now) const;
  PacketContent compose(const Agenda& agenda, double budget, Agenda& done, double now);
  void addBeacon(PacketContent& content, const Agenda& agenda, double budget, Agenda& done, double now);
  void addObservations(PacketContent& content, double budget, double now);
  void addRecords(PacketContent& content, double budget, double now);
  Beacon beacon(double now) const;
  std::vector<Echo> echoes(double now);
  std::vector<DigestEntry> digest(double now);
  std::vector<Neighbour> neighbours(double now) const;
  bool fits(const PacketContent& content, double budget) const;
  Bytes seal(const PacketContent& content, double now);
  void addEvent(ExchangeEventKind kind, RobotId robot, const std::string& text, std::int64_t contour = 0);

  Sealer sealer_;
  RecordSelector selector_;
  DigestWriter digest_;
  PeerOutlines outlines_;
  OwnEdges edges_;
  TokenBucket bucket_;
  std::map<RobotId, int> reference_revisions_;                // [-] changes of contests and endorsements, per origin
  std::uint32_t counter_ = 0;                                 // [-] of packets sent
  std::deque<std::pair<double, std::uint32_t>> lately_sent_;  // time [s] and counter
  std::vector<ExchangeEvent> events_;
  double scan_sent_ = -1e9;  // [s] stamp of the newest scan that went out
  double warned_ = -1e9;     // [s] of a namesake
  double tidied_ = -1e9;     // [s] when what is old was last looked for
};

}  // namespace parley

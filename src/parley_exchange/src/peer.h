// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <map>
#include <optional>

#include "clock_offset.h"
#include "knowledge.h"
#include "parley_exchange/exchange.h"
#include "receiver.h"

namespace parley {

/// The latest message of a kind, and when it was sent and came.
template <class Message>
struct Latest {
  Message message;
  std::uint32_t counter = 0;  // [-] of its packet
  std::uint32_t stamp = 0;    // [ticks] of the peer's clock
  double received = 0.0;      // [s]
};

/// A scan that was told of.
struct HeardScan {
  std::uint32_t stamp = 0;  // [ticks] of the peer's clock
  double received = 0.0;    // [s]
  Pose2 pose;               // T_odom_base
  std::vector<Observation> blobs;
};

/// Another robot, as long as it is heard now and then.
struct Peer {
  std::uint32_t boot = 0;
  double first_heard = 0.0;  // [s]
  double last_heard = 0.0;   // [s]
  std::uint32_t last_counter = 0;
  ClockOffset clock;
  Knowledge knowledge;
  std::optional<Latest<Beacon>> beacon;
  std::optional<Latest<TrajectoryMessage>> trajectory;
  std::optional<Latest<IntentMessage>> intent;
  std::optional<Latest<std::vector<Conflict>>> conflicts;
  std::deque<HeardScan> scans;  // the last, in the order in which they came
  double heard_there = 0.0;     // [-]
  double proven_until = -1e9;   // [s]
  double echoed_at = -1e9;      // [s] when its packets were last told of
  bool confirmed = false;       // its pose is known
  bool duplicate_told = false;

  bool isNeighbour(double now, double timeout) const { return now - last_heard <= timeout; }
};

using PeerMap = std::map<RobotId, Peer>;

/// Takes what a packet says of its sender into the peer, if it is newer and can be true. Counts what cannot.
void updatePeer(Peer& peer, RobotId sender, const PacketContent& content, std::uint32_t counter, double now,
                const ExchangeOptions& options, ExchangeCounters& counters);

/// What the peer says of packets from here. `lately` tells whether a counter modulo 2^16 was sent in the last seconds.
template <class Lately>
void takeEchoes(Peer& peer, RobotId self, const std::vector<Echo>& echoes, double now, const Lately& lately) {
  for (const Echo& echo : echoes) {
    if (echo.robot != self || !lately(echo.counter)) continue;
    peer.clock.echoed(echo.difference, now);
    peer.heard_there = echo.heard;
    peer.proven_until = now + 10.0;
  }
}

/// As it is shown to other stages.
PeerState stateOf(RobotId id, const Peer& peer, const Sender* sender, double now, double neighbour_timeout);
PeerTrajectory trajectoryOf(const Peer& peer, double now);
std::vector<PeerObservations> observationsOf(const Peer& peer, double now);

}  // namespace parley

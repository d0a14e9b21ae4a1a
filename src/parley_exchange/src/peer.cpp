// SPDX-License-Identifier: BSD-3-Clause
#include "peer.h"

#include <algorithm>
#include <cmath>

#include "checks.h"

namespace parley {
namespace {

constexpr std::int64_t kSameScan = 80;  // [ticks] scans are further apart
constexpr std::size_t kHeldScans = 16;  // [-] of each peer

/// Replaces what is older. False if the message cannot be true.
template <class Message>
void take(std::optional<Latest<Message>>& into, const std::optional<Message>& message, bool plausible,
          const Latest<Message>& stamps, ExchangeCounters& counters) {
  if (!message) return;
  if (!plausible) {
    ++counters.implausible;
    return;
  }
  if (into && into->counter > stamps.counter) return;
  into = stamps;
  into->message = *message;
}

/// Keeps what is not known yet. The same scan's stamp differs from packet to packet by the rounding of its age.
void takeScans(Peer& peer, const PacketContent& content, double now, const Plausibility& plausible, ExchangeCounters& counters) {
  for (auto scan = content.observations.rbegin(); scan != content.observations.rend(); ++scan) {
    if (!plausible.holds(*scan)) {
      ++counters.implausible;
      continue;
    }
    const std::uint32_t stamp = content.stamp - ticksOf(scan->age);
    const bool known = std::any_of(peer.scans.begin(), peer.scans.end(), [stamp](const HeardScan& other) {
      return std::abs(static_cast<std::int64_t>(static_cast<std::int32_t>(stamp - other.stamp))) < kSameScan;
    });
    if (known) continue;
    peer.scans.push_back({stamp, now, scan->pose, scan->blobs});
    if (peer.scans.size() > kHeldScans) peer.scans.pop_front();
  }
}

/// Distance driven from one pose to the next, negative backwards. [m]
double signedStep(const Pose2& from, const Pose2& to) {
  const Eigen::Vector2d step = to.position() - from.position();
  return step.dot(from.direction() + to.direction()) < 0.0 ? -step.norm() : step.norm();
}

}  // namespace

void updatePeer(Peer& peer, RobotId sender, const PacketContent& content, std::uint32_t counter, double now,
                const ExchangeOptions& options, ExchangeCounters& counters) {
  const Plausibility plausible{options.max_speed, options.max_turn_rate};
  peer.clock.heard(content.stamp, now);
  peer.last_heard = now;
  peer.last_counter = std::max(peer.last_counter, counter);
  const bool own_name = content.beacon && robotIdOf(content.beacon->name) == sender;
  take(peer.beacon, content.beacon, own_name && plausible.holds(*content.beacon), {{}, counter, content.stamp, now}, counters);
  take(peer.trajectory, content.trajectory, content.trajectory && plausible.holds(*content.trajectory),
       {{}, counter, content.stamp, now}, counters);
  take(peer.intent, content.intent, content.intent && plausible.holds(*content.intent), {{}, counter, content.stamp, now},
       counters);
  const bool conflicts_hold = content.conflicts && std::all_of(content.conflicts->begin(), content.conflicts->end(),
                                                               [&](const Conflict& c) { return plausible.holds(c); });
  take(peer.conflicts, content.conflicts, conflicts_hold, {{}, counter, content.stamp, now}, counters);
  takeScans(peer, content, now, plausible, counters);
}

PeerState stateOf(RobotId id, const Peer& peer, const Sender* sender, double now, double neighbour_timeout) {
  PeerState state;
  state.id = id;
  state.boot = peer.boot;
  state.first_heard = peer.first_heard;
  state.last_heard = peer.last_heard;
  state.neighbour = peer.isNeighbour(now, neighbour_timeout);
  state.proven = now < peer.proven_until;
  state.clock_known = peer.clock.known(now);
  state.clock_error = peer.clock.error(now);
  state.heard_there = peer.heard_there;
  if (sender != nullptr) {
    state.heard = sender->window.receivedShare();
    state.duplicate = sender->stale_advances >= 3;
  }
  if (!peer.beacon) return state;
  const Beacon& beacon = peer.beacon->message;
  state.name = beacon.name;
  state.odometry.stamp = peer.clock.ownTime(peer.beacon->stamp, now) - beacon.age;
  state.odometry.pose = beacon.pose;
  state.odometry.twist = beacon.twist;
  state.footprint = beacon.footprint;
  state.limits = beacon.limits;
  state.state = beacon.state;
  return state;
}

PeerTrajectory trajectoryOf(const Peer& peer, double now) {
  const TrajectoryMessage& message = peer.trajectory->message;
  const double start = peer.clock.ownTime(peer.trajectory->stamp, now) + message.start;
  std::vector<TrajectoryPoint> points;
  for (std::size_t i = 0; i < message.poses.size(); ++i) {
    TrajectoryPoint point{start + message.step * static_cast<double>(i), message.poses[i], {}};
    const bool inner = i > 0 && i + 1 < message.poses.size();
    const std::size_t before = i > 0 ? i - 1 : i, after = std::min(i + 1, message.poses.size() - 1);
    // It ends standing; elsewhere the twist is that of the poses around.
    if (i + 1 < message.poses.size()) {
      const double span = message.step * (inner ? 2.0 : 1.0);
      point.twist.speed = signedStep(message.poses[before], message.poses[after]) / span;
      point.twist.turn_rate = angleBetween(message.poses[before].yaw, message.poses[after].yaw) / span;
    }
    points.push_back(point);
  }
  return {peer.trajectory->received, message.state, SampledTrajectory(std::move(points))};
}

std::vector<PeerObservations> observationsOf(const Peer& peer, double now) {
  std::vector<PeerObservations> observations;
  for (const HeardScan& scan : peer.scans) {
    observations.push_back({peer.clock.ownTime(scan.stamp, now), scan.received, scan.pose, scan.blobs});
  }
  return observations;
}

}  // namespace parley

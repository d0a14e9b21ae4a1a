// SPDX-License-Identifier: BSD-3-Clause
#include "peer.h"

#include <algorithm>
#include <cmath>

#include "checks.h"

namespace parley {
namespace {

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
  take(peer.observations, content.observations, content.observations && plausible.holds(*content.observations),
       {{}, counter, content.stamp, now}, counters);
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

PeerObservations observationsOf(const Peer& peer, double now) {
  const Latest<ObservationMessage>& latest = *peer.observations;
  return {peer.clock.ownTime(latest.stamp, now) - latest.message.age, latest.received, latest.message.pose, latest.message.blobs};
}

}  // namespace parley

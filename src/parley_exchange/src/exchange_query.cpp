// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "body_codec.h"
#include "exchange_core.h"
#include "outline.h"

namespace parley {
namespace {

/// Calls `take` with each record of a kind that is not removed, in the order of their ids.
template <class Take>
void forEach(const Log* log, RecordKind kind, const Take& take) {
  if (log == nullptr) return;
  for (auto name = log->names.lower_bound({kind, 0}); name != log->names.end() && name->first.first == kind; ++name) {
    const StoredRecord& stored = log->records.at(name->second);
    if (!stored.record.removed) take(stored);
  }
}

template <class Message>
const Peer* peerWith(const PeerMap& peers, RobotId id, std::optional<Latest<Message>> Peer::*message) {
  const auto peer = peers.find(id);
  return peer != peers.end() && (peer->second.*message) ? &peer->second : nullptr;
}

}  // namespace

std::vector<PeerState> Exchange::peers(double now) const {
  std::vector<PeerState> states;
  for (const auto& peer : core_->peers) {
    states.push_back(stateOf(peer.first, peer.second, core_->receiver.find(peer.first), now, core_->options.neighbour_timeout));
  }
  return states;
}

std::optional<PeerTrajectory> Exchange::trajectoryOf(RobotId peer, double now) const {
  const Peer* known = peerWith(core_->peers, peer, &Peer::trajectory);
  return known != nullptr ? std::make_optional(parley::trajectoryOf(*known, now)) : std::nullopt;
}

std::optional<PeerIntent> Exchange::intentOf(RobotId peer) const {
  const Peer* known = peerWith(core_->peers, peer, &Peer::intent);
  if (known == nullptr) return std::nullopt;
  return PeerIntent{known->intent->received, known->intent->message};
}

std::optional<PeerConflicts> Exchange::conflictsOf(RobotId peer) const {
  const Peer* known = peerWith(core_->peers, peer, &Peer::conflicts);
  if (known == nullptr) return std::nullopt;
  return PeerConflicts{known->conflicts->received, known->conflicts->message};
}

std::vector<PeerObservations> Exchange::observationsOf(RobotId peer, double now) const {
  const auto known = core_->peers.find(peer);
  return known != core_->peers.end() ? parley::observationsOf(known->second, now) : std::vector<PeerObservations>{};
}

std::vector<RobotId> Exchange::origins() const {
  std::vector<RobotId> origins;
  for (const auto& log : core_->store.logs()) {
    if (log.first.stream == RecordStream::kMap) origins.push_back(log.first.origin);
  }
  return origins;
}

int Exchange::mapRevision(RobotId origin) const { return core_->mapRevision(origin); }

std::vector<SharedContour> Exchange::contoursOf(RobotId origin) const {
  std::vector<SharedContour> contours;
  forEach(core_->store.find({origin, RecordStream::kMap}), RecordKind::kContour, [&](const StoredRecord& stored) {
    const auto body = decodeContour(stored.record.body);
    if (!body) return;
    SharedContour contour;
    contour.name = {origin, stored.record.id, stored.record.sequence};
    contour.anchor = body->anchor;
    contour.polygon = polygonOf(*body);
    contour.closed = body->closed;
    contour.hole = body->hole;
    contour.hops = stored.record.hops;
    contour.written = contour.confirmed = stored.written;
    contour.endorsements = core_->references.endorsements(contour.name);
    contour.contested = core_->references.contestOf(contour.name).has_value();
    const ReferenceList* list = core_->references.find({origin, stored.record.id});
    for (std::size_t i = 0; list != nullptr && i < list->endorsed.size(); ++i) {
      if (list->endorsed[i].first == contour.name.sequence)
        contour.confirmed = std::max(contour.confirmed, list->endorsed[i].second);
    }
    contours.push_back(std::move(contour));
  });
  return contours;
}

std::vector<SharedAnchor> Exchange::anchorsOf(RobotId origin) const {
  std::vector<SharedAnchor> anchors;
  forEach(core_->store.find({origin, RecordStream::kMap}), RecordKind::kAnchor, [&](const StoredRecord& stored) {
    const auto body = decodeAnchor(stored.record.body);
    if (body) anchors.push_back({stored.record.id, body->pose, body->position_sigma, body->yaw_sigma, stored.written});
  });
  return anchors;
}

std::vector<SharedEdge> Exchange::edges() const {
  std::vector<SharedEdge> edges;
  for (const auto& log : core_->store.logs()) {
    forEach(&log.second, RecordKind::kEdge, [&](const StoredRecord& stored) {
      const auto body = decodeEdge(stored.record.body);
      if (body) edges.push_back({log.first.origin, *body, stored.record.hops, stored.written});
    });
  }
  return edges;
}

std::vector<SharedKeyframe> Exchange::keyframesOf(RobotId origin, double now) const {
  std::vector<SharedKeyframe> keyframes;
  const auto peer = core_->peers.find(origin);
  forEach(core_->store.find({origin, RecordStream::kKeyframes}), RecordKind::kKeyframe, [&](const StoredRecord& stored) {
    const auto body = decodeKeyframe(stored.record.body);
    if (!body) return;
    const double stamp = peer != core_->peers.end() ? peer->second.clock.ownTime(body->stamp, now) : stored.written;
    keyframes.push_back({stored.record.sequence, stamp, body->pose, body->descriptor});
  });
  std::sort(keyframes.begin(), keyframes.end(), [](const SharedKeyframe& a, const SharedKeyframe& b) { return a.id < b.id; });
  return keyframes;
}

}  // namespace parley

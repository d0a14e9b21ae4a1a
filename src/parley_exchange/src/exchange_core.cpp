// SPDX-License-Identifier: BSD-3-Clause
#include "exchange_core.h"

#include <algorithm>
#include <limits>

#include "body_codec.h"
#include "checks.h"

namespace parley {
namespace {

constexpr std::size_t kMaxEvents = 256;  // [-] held until the next step

StoreLimits limitsOf(const ExchangeOptions& options) {
  return {options.max_origins, options.max_records, options.max_log_bytes, options.max_total_bytes};
}

}  // namespace

Exchange::Core::Core(const ExchangeOptions& given_options, const ExchangeIdentity& given_identity)
    : options(given_options),
      identity(given_identity),
      self(robotIdOf(given_identity.name)),
      receiver(options, self, identity.boot),
      store(limitsOf(options), self),
      map_log(store, ownMapName(), identity.boot),
      keyframe_log(store, ownKeyframesName(), identity.boot),
      map(options, map_log),
      pace(options, self),
      sealer_(identity.key),
      selector_(options, self),
      outlines_(options.endorse_distance),
      edges_(map_log, options.contour_interval, options.max_edges),
      bucket_(options.rate, options.burst) {}

void Exchange::Core::addPacket(const Bytes& datagram, double now) {
  ++counters.packets_received;
  const std::optional<OpenedPacket> packet = receiver.open(datagram, sealer_, now, counters);
  Peer* peer = packet ? admit(packet->header, now) : nullptr;
  if (peer == nullptr) return;
  ++counters.packets_accepted;
  const PacketContent content = decodePacket(packet->plain);
  counters.sections_malformed += content.malformed_sections;
  counters.sections_unknown += content.unknown_sections;
  updatePeer(*peer, packet->header.sender, content, packet->header.counter, now, options, counters);
  takeEchoes(*peer, self, content.echoes, now, [this](std::uint16_t counter) {
    return std::any_of(lately_sent_.begin(), lately_sent_.end(),
                       [counter](const auto& sent) { return (sent.second & 0xffffU) == counter; });
  });
  takeDigest(*peer, content);
  for (const RecordGroup& group : content.records) takeRecords(*peer, group, now);
}

Peer* Exchange::Core::admit(const FrameHeader& header, double now) {
  auto known = peers.find(header.sender);
  if (known == peers.end() && peers.size() >= static_cast<std::size_t>(options.max_peers)) {
    ++counters.dropped_table;
    return nullptr;
  }
  const bool restarted = known != peers.end() && known->second.boot != header.boot;
  if (restarted) addEvent(ExchangeEventKind::kPeerRestarted, header.sender, "a peer has started anew");
  if (known == peers.end() || restarted) {
    Peer fresh;
    fresh.boot = header.boot;
    fresh.first_heard = now;
    fresh.knowledge = Knowledge(static_cast<std::size_t>(2 * options.max_origins + 2));
    if (!restarted) addEvent(ExchangeEventKind::kPeerAppeared, header.sender, "a peer is heard");
    known = peers.insert_or_assign(header.sender, std::move(fresh)).first;
    store.startEpoch({header.sender, RecordStream::kMap}, header.boot);
    store.startEpoch({header.sender, RecordStream::kKeyframes}, header.boot);
    if (restarted) poses.erase(header.sender);
    if (restarted) updateReferences();
  }
  return &known->second;
}

void Exchange::Core::takeDigest(Peer& peer, const PacketContent& content) {
  for (const DigestEntry& entry : content.digest) peer.knowledge.learn(entry);
  if (content.beacon && peer.beacon && content.beacon->map_hash == store.mapHash()) peer.knowledge.learnMaps(store);
}

void Exchange::Core::takeRecords(Peer& peer, const RecordGroup& group, double now) {
  const LogName name{group.origin, group.stream};
  for (const Record& record : group.records) {
    ++counters.records_received;
    if (group.origin != self) takeRecord(peer, name, group.epoch, record, now);
    if (group.origin == self && group.epoch == identity.boot) {
      peer.knowledge.learn(name, group.epoch, record.sequence - record.gap, record.sequence);
    }
  }
}

void Exchange::Core::takeRecord(Peer& peer, const LogName& name, std::uint32_t epoch, Record record, double now) {
  const Plausibility plausible{options.max_speed, options.max_turn_rate};
  if (!plausible.holds(record)) {
    ++counters.implausible;
    return;
  }
  record.hops = std::min(7, record.hops + 1);
  const Log* before = store.find(name);
  const bool is_fresh_log = before == nullptr || before->epoch != epoch;
  const bool refers = record.kind == RecordKind::kContest || record.kind == RecordKind::kEndorsement;
  const MergeResult result = store.merge(name, epoch, record, now);
  if (result == MergeResult::kOldEpoch) ++counters.records_old_epoch;
  if (result == MergeResult::kRefused) ++counters.records_refused;
  if (result == MergeResult::kOldEpoch || result == MergeResult::kRefused) return;
  peer.knowledge.learn(name, epoch, record.sequence - record.gap, record.sequence);
  Log& log = *store.find(name);
  const auto stored = log.records.find(record.sequence);
  if (result == MergeResult::kKnown) {
    digest_.sentInVain(name);
    if (stored != log.records.end()) selector_.overheard(stored->second, now);
    return;
  }
  ++counters.records_new;
  if (stored != log.records.end()) selector_.learned(stored->second, name.origin, now);
  if (refers || is_fresh_log) updateReferences();
}

void Exchange::Core::updateReferences() { tellContested(references.rebuild(store)); }

void Exchange::Core::tellContested(const std::vector<References::Target>& changed) {
  for (const References::Target& target : changed) {
    ++reference_revisions_[target.first];
    const Log* own = target.first == self ? map_log.log() : nullptr;
    const StoredRecord* contour = own != nullptr ? own->find(RecordKind::kContour, target.second) : nullptr;
    if (contour == nullptr || !references.contestOf({self, target.second, contour->record.sequence})) continue;
    const auto key = map.keyOf(target.second);
    if (key) addEvent(ExchangeEventKind::kContourContested, self, "another robot saw through a contour of this one", *key);
  }
}

int Exchange::Core::mapRevision(RobotId origin) const {
  const Log* log = store.find({origin, RecordStream::kMap});
  const auto references_changed = reference_revisions_.find(origin);
  return (log != nullptr ? log->revision : 0) +
         (references_changed != reference_revisions_.end() ? references_changed->second : 0);
}

void Exchange::Core::publishContours(const std::vector<OwnContour>& contours, double now) {
  std::map<RobotId, int> revisions;
  for (const auto& pose : poses) revisions[pose.first] = mapRevision(pose.first);
  outlines_.update(poses, store, references, revisions);
  const int before = mapRevision(self);
  counters.contours_refused += map.publish(contours, outlines_, references, now);
  if (mapRevision(self) != before) updateReferences();
}

bool Exchange::Core::contest(const ContourName& contour, double now) {
  if (contour.origin == self || currentContour(store, contour) == nullptr) return false;
  const std::uint32_t epoch = store.find({contour.origin, RecordStream::kMap})->epoch;
  const bool written = references.add(RecordKind::kContest, contour, epoch, map_log, now);
  updateReferences();
  return written;
}

bool Exchange::Core::setPeerPose(RobotId peer, const PeerPose& pose, double now) {
  const bool usable = peer != self && isPlace(pose.T_odom_peer.pose) && isCovariance(pose.T_odom_peer.covariance);
  const bool full = poses.count(peer) == 0 && poses.size() >= static_cast<std::size_t>(options.max_origins);
  if (!usable || full) return false;
  poses[peer] = pose;
  if (pose.state == EdgeState::kWithdrawn) poses.erase(peer);
  const auto known = peers.find(peer);
  if (known != peers.end()) known->second.confirmed = pose.state == EdgeState::kConfirmed;
  if (pose.measured) publishEdge(peer, pose, now);
  return true;
}

std::optional<SharedAnchor> Exchange::Core::anchorNear(RobotId origin, const Eigen::Vector2d& position) const {
  std::optional<SharedAnchor> nearest;
  double least = std::numeric_limits<double>::infinity();
  const Log* log = store.find({origin, RecordStream::kMap});
  if (log == nullptr) return nearest;
  const auto begin = log->names.lower_bound({RecordKind::kAnchor, 0});
  for (auto name = begin; name != log->names.end() && name->first.first == RecordKind::kAnchor; ++name) {
    const Record& record = log->records.at(name->second).record;
    const auto body = decodeAnchor(record.body);
    if (!body || (body->pose.position() - position).norm() >= least) continue;
    least = (body->pose.position() - position).norm();
    nearest = SharedAnchor{record.id, body->pose, body->position_sigma, body->yaw_sigma, 0.0};
  }
  return nearest;
}

void Exchange::Core::publishEdge(RobotId peer, const PeerPose& pose, double now) {
  const auto known = peers.find(peer);
  if (known == peers.end() || !known->second.beacon || !odometry) return;
  const auto own = anchorNear(self, odometry->pose.position());
  const auto theirs = anchorNear(peer, known->second.beacon->message.pose.position());
  const Log* log = store.find({peer, RecordStream::kMap});
  if (own && theirs && log != nullptr) edges_.publish(peer, log->epoch, pose, *own, *theirs, now);
}

void Exchange::Core::addEvent(ExchangeEventKind kind, RobotId robot, const std::string& text, std::int64_t contour) {
  if (events_.size() < kMaxEvents) events_.push_back({kind, robot, contour, text});
}

}  // namespace parley

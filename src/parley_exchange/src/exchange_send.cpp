// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "exchange_core.h"
#include "section_codec.h"

namespace parley {
namespace {

constexpr double kFirstContact = 3.0;        // [s] beacons come fast until clocks are known, at most so long
constexpr double kObservationLife = 0.5;     // [s]
constexpr double kSameScan = 0.001;          // [s]
constexpr double kMostScans = 4.0;           // [-] in a packet
constexpr std::size_t kBlobsAtATime = 16;    // [-] in a packet, of all its scans together
constexpr double kEchoWindow = 5.0;          // [s] packets sent from here that an echo may tell of
constexpr std::size_t kEchoesAtATime = 2;    // [-]
constexpr double kTimeToTell = 1.5;          // [s] a neighbour has before it is taken to have nothing
constexpr double kTimeToTellOfOthers = 4.0;  // [s]
constexpr double kWarnInterval = 10.0;       // [s]
constexpr double kTidyInterval = 0.5;        // [s]
constexpr std::size_t kRecordsWorthIt = 24;  // [byte] less room than this is left empty

}  // namespace

ExchangeOutput Exchange::Core::step(double now) {
  forgetOld(now);
  warnOfNamesakes(now);
  if (references.dropOutdated(store, map_log, now)) updateReferences();
  ExchangeOutput output;
  std::swap(output.events, events_);
  const Agenda agenda = pace.agenda(now, beaconRate(now));
  if (agenda.empty()) return output;
  Agenda done;
  const double budget = bucket_.level(now) - kDatagramOverhead;
  const PacketContent content = compose(agenda, budget, done, now);
  if (done.empty()) return output;
  output.packets.push_back(seal(content, now));
  pace.sent(done, now);
  return output;
}

bool Exchange::Core::fits(const PacketContent& content, double budget) const {
  const std::size_t size = encodePacket(content).size() + kFrameBytes;
  return size <= static_cast<std::size_t>(options.packet_size) && static_cast<double>(size) <= budget;
}

PacketContent Exchange::Core::compose(const Agenda& agenda, double budget, Agenda& done, double now) {
  PacketContent content;
  content.stamp = ticksOf(now);
  if (agenda.trajectory) {
    content.trajectory = trajectoryMessage(pace.trajectory(), trajectory_state, now);
    done.trajectory = fits(content, budget);
    if (!done.trajectory) content.trajectory.reset();
    if (done.trajectory && agenda.intent && intent) {
      content.intent = intent;
      done.intent = fits(content, budget);
      if (!done.intent) content.intent.reset();
    }
  }
  if (agenda.conflicts) {
    content.conflicts = pace.conflicts();
    done.conflicts = fits(content, budget);
    if (!done.conflicts) content.conflicts.reset();
  }
  if (agenda.beacon && odometry) addBeacon(content, agenda, budget, done, now);
  if (done.empty()) return content;
  addObservations(content, budget, now);
  addRecords(content, budget, now);
  return content;
}

void Exchange::Core::addBeacon(PacketContent& content, const Agenda& agenda, double budget, Agenda& done, double now) {
  content.beacon = beacon(now);
  done.beacon = fits(content, budget);
  if (!done.beacon) {
    content.beacon.reset();
    return;
  }
  if (!agenda.full_beacon) return;
  // Both are small, and there is always another beacon.
  content.echoes = echoes(now);
  if (!fits(content, budget)) content.echoes.clear();
  content.digest = digest(now);
  if (!fits(content, budget)) content.digest.clear();
  done.full_beacon = true;
}

void Exchange::Core::addObservations(PacketContent& content, double budget, double now) {
  const double stamp = scans.empty() ? -1e9 : scans_at - scans.front().age;
  if (now - stamp >= kObservationLife || neighbourCount(now) == 0) return;
  const std::size_t count = scansToTell(now);
  if (count == 1 && stamp < scan_sent_ + kSameScan) return;
  std::size_t blobs = 0;
  for (const ObservationMessage& scan : scans) {
    blobs += scan.blobs.size();
    if (content.observations.size() == count || (!content.observations.empty() && blobs > kBlobsAtATime)) break;
    content.observations.push_back(scan);
    content.observations.back().age += std::max(0.0, now - scans_at);
  }
  while (!content.observations.empty() && !fits(content, budget)) content.observations.pop_back();
  if (!content.observations.empty()) scan_sent_ = stamp;
}

/// So many that each neighbour whose pose is not known hears of each scan about once, however much is lost.
std::size_t Exchange::Core::scansToTell(double now) const {
  double need = 1.0;
  for (const auto& [id, peer] : peers) {
    if (peer.confirmed || !peer.isNeighbour(now, options.neighbour_timeout)) continue;
    const double heard = now < peer.proven_until ? peer.heard_there : receiver.find(id)->window.receivedShare();
    need = std::max(need, 1.0 / std::max(heard, 0.01));
  }
  return static_cast<std::size_t>(std::clamp(std::round(need), 1.0, kMostScans));
}

void Exchange::Core::addRecords(PacketContent& content, double budget, double now) {
  const double used = static_cast<double>(encodePacket(content).size() + kFrameBytes);
  const double room = std::min(static_cast<double>(options.packet_size), budget - options.record_reserve) - used;
  if (room < static_cast<double>(kRecordsWorthIt)) return;
  content.records = selector_.select(store, neighbours(now), static_cast<std::size_t>(room), now);
}

Bytes Exchange::Core::seal(const PacketContent& content, double now) {
  const Bytes plain = encodePacket(content);
  Bytes frame = sealer_.seal({self, identity.boot, ++counter_}, plain);
  const double cost = static_cast<double>(frame.size()) + kDatagramOverhead;
  bucket_.spend(cost);
  receiver.sent(counter_, frame);
  lately_sent_.emplace_back(now, counter_);
  while (now - lately_sent_.front().first > kEchoWindow) lately_sent_.pop_front();
  ++counters.packets_sent;
  counters.bytes_sent += static_cast<std::int64_t>(cost);
  counters.sections_sent += sectionBytes(plain);
  return frame;
}

Beacon Exchange::Core::beacon(double now) const {
  Beacon beacon;
  beacon.name = identity.name;
  beacon.age = std::max(0.0, now - odometry->stamp);
  beacon.pose = odometry->pose;
  beacon.twist = odometry->twist;
  beacon.footprint = identity.footprint;
  beacon.limits = identity.limits;
  beacon.state = state;
  beacon.neighbours = neighbourCount(now);
  beacon.map_hash = store.mapHash();
  return beacon;
}

std::vector<Echo> Exchange::Core::echoes(double now) {
  std::vector<std::pair<double, RobotId>> turns;
  for (const auto& peer : peers) {
    if (peer.second.isNeighbour(now, options.neighbour_timeout)) turns.emplace_back(peer.second.echoed_at, peer.first);
  }
  std::sort(turns.begin(), turns.end());
  turns.resize(std::min(turns.size(), kEchoesAtATime));
  std::vector<Echo> result;
  for (const auto& turn : turns) {
    Peer& peer = peers.at(turn.second);
    peer.echoed_at = now;
    result.push_back({turn.second, static_cast<std::uint16_t>(peer.last_counter & 0xffff), *peer.clock.difference(),
                      receiver.find(turn.second)->window.receivedShare()});
  }
  return result;
}

std::vector<DigestEntry> Exchange::Core::digest(double now) {
  const std::uint32_t hash = store.mapHash();
  bool all_equal = true;
  int count = 0;
  for (const auto& peer : peers) {
    if (!peer.second.isNeighbour(now, options.neighbour_timeout)) continue;
    ++count;
    all_equal = all_equal && peer.second.beacon && peer.second.beacon->message.map_hash == hash;
  }
  if (count == 0) return {};
  return digest_.next(store, static_cast<std::size_t>(options.digest_entries), all_equal, [&](const LogName& name) {
    const auto origin = peers.find(name.origin);
    const bool heard = origin != peers.end() && origin->second.isNeighbour(now, options.neighbour_timeout);
    return name.origin != self && (name.stream == RecordStream::kMap || heard);
  });
}

std::vector<Neighbour> Exchange::Core::neighbours(double now) const {
  std::vector<Neighbour> result;
  for (const auto& entry : peers) {
    const Peer& peer = entry.second;
    if (!peer.isNeighbour(now, options.neighbour_timeout)) continue;
    const double known_for = now - peer.first_heard;
    result.push_back({entry.first, &peer.knowledge, peer.confirmed, peer.beacon.has_value() || known_for > kTimeToTell,
                      known_for > kTimeToTellOfOthers});
  }
  return result;
}

int Exchange::Core::neighbourCount(double now) const {
  return static_cast<int>(std::count_if(
      peers.begin(), peers.end(), [&](const auto& peer) { return peer.second.isNeighbour(now, options.neighbour_timeout); }));
}

double Exchange::Core::beaconRate(double now) const {
  const bool sees = !scans.empty() && now - scans_at + scans.front().age < kObservationLife && !scans.front().blobs.empty();
  double need = 0.0;
  int count = 0;
  for (const auto& entry : peers) {
    const Peer& peer = entry.second;
    if (!peer.isNeighbour(now, options.neighbour_timeout)) continue;
    ++count;
    if (!peer.clock.known(now) && now - peer.first_heard < kFirstContact) need = std::max(need, 1.0);
    if (sees && !peer.confirmed) need = std::max(need, 0.5);
  }
  const double crowd = std::max(1.0, static_cast<double>(count) / options.beacon_crowd);
  return std::max(options.beacon_rate_min, need * options.beacon_rate_max / crowd);
}

void Exchange::Core::forgetOld(double now) {
  if (now >= tidied_ && now - tidied_ < kTidyInterval) return;
  tidied_ = now;
  for (auto peer = peers.begin(); peer != peers.end();) {
    if (now - peer->second.last_heard <= options.peer_timeout) {
      ++peer;
      continue;
    }
    addEvent(ExchangeEventKind::kPeerLost, peer->first, "a peer is no longer heard");
    peer = peers.erase(peer);
  }
  std::map<RobotId, double> newest;
  for (const auto& log : store.logs()) {
    double& time = newest.emplace(log.first.origin, -1e18).first->second;
    for (const auto& record : log.second.records) time = std::max(time, record.second.arrived);
  }
  bool any = false;
  for (const auto& origin : newest) {
    if (origin.first == self || peers.count(origin.first) != 0 || now - origin.second <= options.origin_timeout) continue;
    store.forget(origin.first);
    poses.erase(origin.first);
    any = true;
  }
  if (any) updateReferences();
}

void Exchange::Core::warnOfNamesakes(double now) {
  if (receiver.takeOwnNameHeard() && now - warned_ > kWarnInterval) {
    warned_ = now;
    addEvent(ExchangeEventKind::kDuplicateName, self,
             "another robot sends under the name " + identity.name + ", or this one's boot counter was set back");
  }
  for (auto& peer : peers) {
    const Sender* sender = receiver.find(peer.first);
    if (peer.second.duplicate_told || sender == nullptr || sender->stale_advances < 3) continue;
    peer.second.duplicate_told = true;
    const std::string name = peer.second.beacon ? peer.second.beacon->message.name : "unknown";
    addEvent(ExchangeEventKind::kDuplicateName, peer.first, "two robots, or recordings of one, send under the name " + name);
  }
}

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#include "record_selector.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "section_codec.h"

namespace parley {
namespace {

/// What goes first. [-]
int urgencyOf(const Record& record) {
  if (record.removed) return 1;
  switch (record.kind) {
    case RecordKind::kEdge:
      return 0;
    case RecordKind::kContest:
    case RecordKind::kAnchor:
      return 1;
    case RecordKind::kContour:
      return 2;
    case RecordKind::kEndorsement:
      return 3;
    case RecordKind::kKeyframe:
      return 4;
  }
  return 3;
}

/// A number in [0, 1) that follows from three others, evenly spread.
double spread(std::uint64_t a, std::uint64_t b, std::uint64_t c) {
  std::uint64_t hash = (a * 0x9e3779b97f4a7c15ULL) ^ (b * 0xc2b2ae3d27d4eb4fULL) ^ (c * 0x165667b19e3779f9ULL);
  hash = (hash ^ (hash >> 29)) * 0xbf58476d1ce4e5b9ULL;
  return static_cast<double>((hash ^ (hash >> 32)) >> 11) * 0x1.0p-53;
}

}  // namespace

struct RecordSelector::Candidate {
  LogName name;
  Log* log;
  StoredRecord* stored;

  auto rank(RobotId self) const {
    // What has been sent again and again waits for what never was, even if that is less urgent.
    return std::make_tuple(urgencyOf(stored->record) + stored->sends, name.origin != self, -stored->written, name.origin,
                           stored->record.sequence);
  }
};

double RecordSelector::spacing(int sends) const {
  const double grown = options_.resend_interval * std::pow(options_.resend_growth, std::min(sends - 1, 30));
  return std::min(options_.resend_limit, grown);
}

void RecordSelector::overheard(StoredRecord& stored, double now) const {
  ++stored.sends;
  stored.send_after = std::max(stored.send_after, now + spacing(stored.sends));
}

void RecordSelector::learned(StoredRecord& stored, RobotId origin, double now) const {
  stored.send_after = now + options_.relay_delay * (0.5 + spread(self_, origin, stored.record.sequence));
}

bool RecordSelector::lacks(const Neighbour& neighbour, const LogName& name) const {
  if (neighbour.id == name.origin || !neighbour.told) return false;
  if (name.origin == self_) return name.stream == RecordStream::kMap || !neighbour.confirmed;
  return name.stream == RecordStream::kMap && (neighbour.told_of_others || neighbour.knowledge->knows(name));
}

std::vector<RecordSelector::Candidate> RecordSelector::candidates(RecordStore& store, const std::vector<Neighbour>& neighbours,
                                                                  double now) const {
  std::vector<Candidate> found;
  for (auto& entry : store.logs()) {
    std::vector<const Knowledge*> lacking;
    for (const Neighbour& neighbour : neighbours) {
      if (lacks(neighbour, entry.first) && !neighbour.knowledge->hasAll(entry.first, entry.second)) {
        lacking.push_back(neighbour.knowledge);
      }
    }
    if (lacking.empty()) continue;
    for (auto& record : entry.second.records) {
      if (record.second.send_after > now) continue;
      const bool wanted = std::any_of(lacking.begin(), lacking.end(), [&](const Knowledge* knowledge) {
        return !knowledge->has(entry.first, entry.second.epoch, record.first);
      });
      if (wanted) found.push_back({entry.first, &entry.second, &record.second});
    }
  }
  std::sort(found.begin(), found.end(), [this](const Candidate& a, const Candidate& b) { return a.rank(self_) < b.rank(self_); });
  return found;
}

std::vector<RecordGroup> RecordSelector::select(RecordStore& store, const std::vector<Neighbour>& neighbours, std::size_t bytes,
                                                double now) const {
  std::map<LogName, RecordGroup> groups;
  const std::vector<Candidate> found = candidates(store, neighbours, now);
  std::size_t room = bytes;
  const auto take = [&](const Candidate& candidate, std::size_t limit) {
    Record record = candidate.stored->record;
    record.gap = candidate.log->gapBefore(record.sequence);
    record.age = std::max(0.0, now - candidate.stored->written);
    RecordGroup& group = groups[candidate.name];
    const std::size_t cost = recordBytes(record) + (group.records.empty() ? kGroupBytes : 0);
    if (cost > limit || cost > room || group.records.size() >= kMaxGroupRecords) return false;
    group.records.push_back(std::move(record));
    room -= cost;
    overheard(*candidate.stored, now);
    return true;
  };
  // Keyframes come last, but without them a neighbour never learns where it is: part of the room is theirs.
  auto keyframe_room = static_cast<std::size_t>(options_.keyframe_share * static_cast<double>(bytes));
  for (const Candidate& candidate : found) {
    if (candidate.name.stream != RecordStream::kKeyframes) continue;
    const std::size_t before = room;
    if (take(candidate, keyframe_room)) keyframe_room -= std::min(keyframe_room, before - room);
  }
  for (const Candidate& candidate : found) {
    if (candidate.stored->send_after <= now) take(candidate, room);
  }
  std::vector<RecordGroup> result;
  for (auto& group : groups) {
    if (group.second.records.empty()) continue;
    group.second.origin = group.first.origin;
    group.second.stream = group.first.stream;
    group.second.epoch = store.find(group.first)->epoch;
    std::sort(group.second.records.begin(), group.second.records.end(),
              [](const Record& a, const Record& b) { return a.sequence < b.sequence; });
    result.push_back(std::move(group.second));
  }
  return result;
}

}  // namespace parley

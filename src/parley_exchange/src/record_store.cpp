// SPDX-License-Identifier: BSD-3-Clause
#include "record_store.h"

#include <algorithm>

namespace parley {
namespace {

constexpr std::size_t kMaxIntervalsHeld = 64;  // [-] more would be a sign of something odd; the upper ones are forgotten

/// Mixes a number into a hash (the finaliser of splitmix64).
std::uint64_t mix(std::uint64_t hash, std::uint64_t number) {
  hash += number + 0x9e3779b97f4a7c15ULL;
  hash = (hash ^ (hash >> 30)) * 0xbf58476d1ce4e5b9ULL;
  hash = (hash ^ (hash >> 27)) * 0x94d049bb133111ebULL;
  return hash ^ (hash >> 31);
}

/// Two entries with one sequence number: no honest origin writes that.
bool contradicts(const Log& log, const Record& record) {
  const auto same = log.records.find(record.sequence);
  return same != log.records.end() && (same->second.record.kind != record.kind || same->second.record.id != record.id);
}

void erase(Log& log, std::uint32_t sequence) {
  const auto record = log.records.find(sequence);
  log.bytes -= record->second.record.body.size();
  log.records.erase(record);
}

}  // namespace

const StoredRecord* Log::find(RecordKind kind, std::uint32_t id) const {
  const auto name = names.find({kind, id});
  return name == names.end() ? nullptr : &records.at(name->second);
}

std::uint32_t Log::gapBefore(std::uint32_t sequence) const {
  if (!covered.contains(sequence)) return 0;
  const auto own = records.lower_bound(sequence);
  const std::uint32_t live = own == records.begin() ? 0 : std::prev(own)->first;
  return sequence - std::max(live + 1, covered.around(sequence).first);
}

Log* RecordStore::admit(const LogName& name, std::uint32_t epoch) {
  const auto known = logs_.find(name);
  if (known != logs_.end()) {
    if (known->second.epoch < epoch) startEpoch(name, epoch);
    return known->second.epoch == epoch ? &known->second : nullptr;
  }
  // Logs are in the order of their origins. Whoever floods a full store costs no memory each time.
  std::size_t origins = name.origin == self_ ? 0 : 1;
  RobotId last = name.origin;
  for (const auto& entry : logs_) {
    const RobotId origin = entry.first.origin;
    if (origin != last && origin != name.origin && origin != self_) ++origins;
    last = origin;
  }
  if (origins > static_cast<std::size_t>(limits_.max_origins)) return nullptr;
  Log& log = logs_[name];
  log.epoch = epoch;
  return &log;
}

bool RecordStore::exceeds(const Log& log, const Record& record, std::size_t replaced) const {
  const bool is_new = log.names.count({record.kind, record.id}) == 0;
  return (is_new && log.names.size() >= static_cast<std::size_t>(limits_.max_records)) ||
         log.bytes - replaced + record.body.size() > static_cast<std::size_t>(limits_.max_bytes) ||
         totalBytes() - replaced + record.body.size() > static_cast<std::size_t>(limits_.max_total_bytes);
}

MergeResult RecordStore::merge(const LogName& name, std::uint32_t epoch, const Record& record, double now) {
  const Log* before = find(name);
  if (before != nullptr && before->epoch > epoch) return MergeResult::kOldEpoch;
  Log* log = admit(name, epoch);
  if (log == nullptr || contradicts(*log, record)) return MergeResult::kRefused;
  const auto entry = log->names.find({record.kind, record.id});
  const bool is_newer = entry == log->names.end() || entry->second < record.sequence;
  const bool was_covered = log->covered.contains(record.sequence);
  if (is_newer) {
    const std::size_t replaced = entry == log->names.end() ? 0 : log->records.at(entry->second).record.body.size();
    if (exceeds(*log, record, replaced)) return MergeResult::kRefused;
    if (entry != log->names.end()) erase(*log, entry->second);
    log->names[{record.kind, record.id}] = record.sequence;
    StoredRecord& stored = log->records[record.sequence];
    stored.record = record;
    stored.written = now - record.age;
    stored.arrived = now;
    log->bytes += record.body.size();
    ++log->revision;
  }
  log->covered.add(record.sequence - record.gap, record.sequence);
  log->covered.limit(kMaxIntervalsHeld);
  return is_newer || !was_covered ? MergeResult::kNew : MergeResult::kKnown;
}

void RecordStore::startEpoch(const LogName& name, std::uint32_t epoch) {
  const auto log = logs_.find(name);
  if (log == logs_.end() || log->second.epoch >= epoch) return;
  const int revision = log->second.revision + 1;
  log->second = Log();
  log->second.epoch = epoch;
  log->second.revision = revision;
}

void RecordStore::forget(RobotId origin) {
  logs_.erase({origin, RecordStream::kMap});
  logs_.erase({origin, RecordStream::kKeyframes});
}

const Log* RecordStore::find(const LogName& name) const {
  const auto log = logs_.find(name);
  return log == logs_.end() ? nullptr : &log->second;
}

Log* RecordStore::find(const LogName& name) {
  const auto log = logs_.find(name);
  return log == logs_.end() ? nullptr : &log->second;
}

std::size_t RecordStore::totalBytes() const {
  std::size_t sum = 0;
  for (const auto& entry : logs_) sum += entry.second.bytes;
  return sum;
}

std::uint32_t RecordStore::mapHash() const {
  std::uint64_t hash = 0;
  for (const auto& entry : logs_) {
    if (entry.first.stream != RecordStream::kMap || entry.second.covered.empty()) continue;
    hash = mix(mix(hash, entry.first.origin), entry.second.epoch);
    for (const Interval& interval : entry.second.covered.intervals()) hash = mix(mix(hash, interval.first), interval.last);
  }
  return static_cast<std::uint32_t>(hash);
}

Record nextVersion(const Log& log, RecordKind kind, std::uint32_t id, const Bytes& body, bool removed) {
  Record record;
  record.kind = kind;
  record.id = id;
  record.removed = removed;
  record.body = body;
  const auto& intervals = log.covered.intervals();
  record.sequence = intervals.empty() ? 1 : intervals.back().last + 1;
  return record;
}

}  // namespace parley

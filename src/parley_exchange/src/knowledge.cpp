// SPDX-License-Identifier: BSD-3-Clause
#include "knowledge.h"

#include <algorithm>

namespace parley {
namespace {

constexpr std::size_t kMaxIntervalsKnown = 64;  // [-]

}  // namespace

Knowledge::Entry* Knowledge::entryOf(const LogName& name, std::uint16_t epoch) {
  const auto known = logs_.find(name);
  if (known == logs_.end() && logs_.size() >= max_logs_) return nullptr;
  Entry& entry = logs_[name];
  if (entry.epoch != epoch) {
    entry.coverage = Coverage();
    entry.epoch = epoch;
  }
  return &entry;
}

void Knowledge::learn(const DigestEntry& digest) {
  Entry* entry = entryOf({digest.origin, digest.stream}, digest.epoch);
  if (entry == nullptr) return;
  Coverage told(digest.intervals);
  const std::uint32_t end = digest.intervals.empty() ? 0 : digest.intervals.back().last;
  told.add(entry->coverage.above(end));
  told.limit(kMaxIntervalsKnown);
  entry->coverage = std::move(told);
}

void Knowledge::learn(const LogName& name, std::uint32_t epoch, std::uint32_t first, std::uint32_t last) {
  Entry* entry = entryOf(name, shortEpoch(epoch));
  if (entry == nullptr) return;
  entry->coverage.add(first, last);
  entry->coverage.limit(kMaxIntervalsKnown);
}

void Knowledge::learnMaps(const RecordStore& store) {
  for (const auto& log : store.logs()) {
    if (log.first.stream != RecordStream::kMap) continue;
    Entry* entry = entryOf(log.first, shortEpoch(log.second.epoch));
    if (entry != nullptr) entry->coverage = log.second.covered;
  }
}

bool Knowledge::has(const LogName& name, std::uint32_t epoch, std::uint32_t sequence) const {
  const auto entry = logs_.find(name);
  return entry != logs_.end() && entry->second.epoch == shortEpoch(epoch) && entry->second.coverage.contains(sequence);
}

bool Knowledge::hasAll(const LogName& name, const Log& log) const {
  const auto entry = logs_.find(name);
  if (entry == logs_.end() || entry->second.epoch != shortEpoch(log.epoch)) return log.records.empty();
  if (entry->second.coverage == log.covered) return true;
  return std::all_of(log.records.begin(), log.records.end(),
                     [&](const auto& record) { return entry->second.coverage.contains(record.first); });
}

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#include "digest_writer.h"

#include <algorithm>

#include "knowledge.h"
#include "section_codec.h"

namespace parley {

std::int64_t DigestWriter::turnOf(const LogName& name, const Log& log) const {
  const auto told = told_.find(name);
  const bool changed = told == told_.end() || told->second.epoch != log.epoch || !(told->second.coverage == log.covered);
  return changed ? 0 : told->second.turn;
}

std::vector<DigestEntry> DigestWriter::tell(const RecordStore& store, std::vector<std::pair<std::int64_t, LogName>> turns,
                                            std::size_t count) {
  std::sort(turns.begin(), turns.end());
  turns.resize(std::min({turns.size(), count, kMaxDigest}));
  ++turn_;
  std::vector<DigestEntry> digest;
  for (const auto& turn : turns) {
    const LogName& name = turn.second;
    const Log& log = *store.find(name);
    DigestEntry entry{name.origin, name.stream, shortEpoch(log.epoch), log.covered.intervals()};
    entry.intervals.resize(std::min(entry.intervals.size(), kMaxIntervals));
    digest.push_back(std::move(entry));
    told_[name] = {log.epoch, log.covered, turn_};
  }
  for (auto told = told_.begin(); told != told_.end();) {
    told = store.find(told->first) == nullptr ? told_.erase(told) : std::next(told);
  }
  return digest;
}

}  // namespace parley

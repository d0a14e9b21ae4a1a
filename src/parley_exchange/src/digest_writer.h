// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <vector>

#include "record_store.h"

namespace parley {

/// Chooses the logs whose coverage a beacon tells: those that changed or that somebody sent in vain, then the others in turn.
class DigestWriter {
 public:
  /// A record came that was here already: its sender does not know.
  void sentInVain(const LogName& name) { told_.erase(name); }

  /// Entries of at most `count` logs that `wanted` holds for; with `changed_only` none in turn.
  template <class Wanted>
  std::vector<DigestEntry> next(const RecordStore& store, std::size_t count, bool changed_only, const Wanted& wanted) {
    std::vector<std::pair<std::int64_t, LogName>> turns;
    for (const auto& entry : store.logs()) {
      if (!wanted(entry.first)) continue;
      const std::int64_t turn = turnOf(entry.first, entry.second);
      if (turn == 0 || !changed_only) turns.emplace_back(turn, entry.first);
    }
    return tell(store, std::move(turns), count);
  }

 private:
  struct Told {
    std::uint32_t epoch = 0;
    Coverage coverage;
    std::int64_t turn = 0;  // [-] of the digest that told it
  };
  /// 0 for what must be told, else the last time it was.
  std::int64_t turnOf(const LogName& name, const Log& log) const;
  std::vector<DigestEntry> tell(const RecordStore& store, std::vector<std::pair<std::int64_t, LogName>> turns, std::size_t count);

  std::map<LogName, Told> told_;
  std::int64_t turn_ = 0;  // [-]
};

}  // namespace parley

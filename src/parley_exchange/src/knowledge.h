// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <vector>

#include "record_store.h"

namespace parley {

/// What a neighbour is known to have, from its digests and from what it sends itself.
class Knowledge {
 public:
  /// Of at most so many logs; what comes later is taken as unknown.
  explicit Knowledge(std::size_t max_logs = 256) : max_logs_(max_logs) {}

  void learn(const DigestEntry& entry);
  void learn(const LogName& name, std::uint32_t epoch, std::uint32_t first, std::uint32_t last);
  /// It covers all that the store does.
  void learnMaps(const RecordStore& store);

  bool has(const LogName& name, std::uint32_t epoch, std::uint32_t sequence) const;
  /// It has all that a log holds.
  bool hasAll(const LogName& name, const Log& log) const;
  /// It has told of this log.
  bool knows(const LogName& name) const { return logs_.count(name) != 0; }

 private:
  struct Entry {
    std::uint16_t epoch = 0;
    Coverage coverage;
  };
  Entry* entryOf(const LogName& name, std::uint16_t epoch);

  std::size_t max_logs_;
  std::map<LogName, Entry> logs_;
};

/// Lowest bits of a boot, which stand for it where room is short.
inline std::uint16_t shortEpoch(std::uint32_t epoch) { return static_cast<std::uint16_t>(epoch & 0xffff); }

}  // namespace parley

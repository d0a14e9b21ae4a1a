// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <utility>

#include "coverage.h"
#include "parley_exchange/messages.h"

namespace parley {

/// Names a log: who writes it, and which of its two.
struct LogName {
  RobotId origin = 0;
  RecordStream stream = RecordStream::kMap;
};
inline bool operator<(const LogName& a, const LogName& b) { return std::tie(a.origin, a.stream) < std::tie(b.origin, b.stream); }
inline bool operator==(const LogName& a, const LogName& b) { return a.origin == b.origin && a.stream == b.stream; }

/// A record with what this robot alone knows of it.
struct StoredRecord {
  Record record;            // gap and age are made anew for each packet
  double written = 0.0;     // [s] when its origin wrote it, this robot's clock
  double arrived = 0.0;     // [s] when it came here
  int sends = 0;            // [-] times sent from here, or heard from others
  double send_after = 0.0;  // [s]
};

/// Everything held of one log, without what was superseded.
struct Log {
  std::uint32_t epoch = 0;
  Coverage covered;                                                     // every record in it that still counts is in `records`
  std::map<std::uint32_t, StoredRecord> records;                        // by sequence
  std::map<std::pair<RecordKind, std::uint32_t>, std::uint32_t> names;  // kind and id to sequence
  std::size_t bytes = 0;                                                // [byte] of the bodies
  int revision = 0;                                                     // [-] counts changes

  /// The newest version, tombstones included.
  const StoredRecord* find(RecordKind kind, std::uint32_t id) const;
  /// Sequence numbers right before this one that are covered and superseded. [-]
  std::uint32_t gapBefore(std::uint32_t sequence) const;
};

enum class MergeResult { kNew, kKnown, kOldEpoch, kRefused };

struct StoreLimits {
  int max_origins = 64;           // [-]
  int max_records = 1024;         // [-] per log
  int max_bytes = 65536;          // [byte] per log
  int max_total_bytes = 1 << 21;  // [byte]
};

/// Replicated logs. Merging is a join: in whatever order, however often, through whomever records come, stores that have
/// got the same are the same. What exceeds a limit is refused and not covered, so it can come again later.
class RecordStore {
 public:
  RecordStore(const StoreLimits& limits, RobotId self) : limits_(limits), self_(self) {}

  MergeResult merge(const LogName& name, std::uint32_t epoch, const Record& record, double now);
  /// An origin is known to have started anew: what it wrote before is dropped.
  void startEpoch(const LogName& name, std::uint32_t epoch);
  void forget(RobotId origin);

  const Log* find(const LogName& name) const;
  Log* find(const LogName& name);
  const std::map<LogName, Log>& logs() const { return logs_; }
  std::map<LogName, Log>& logs() { return logs_; }
  std::size_t totalBytes() const;

  /// Of the coverage of all maps, the same for stores that cover the same.
  std::uint32_t mapHash() const;

 private:
  Log* admit(const LogName& name, std::uint32_t epoch);
  bool exceeds(const Log& log, const Record& record, std::size_t replaced) const;

  StoreLimits limits_;
  RobotId self_;
  std::map<LogName, Log> logs_;
};

/// The robot's own writing: the next version of an entry, or its tombstone.
Record nextVersion(const Log& log, RecordKind kind, std::uint32_t id, const Bytes& body, bool removed);

}  // namespace parley

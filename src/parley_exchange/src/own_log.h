// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "record_store.h"

namespace parley {

/// Writes one of this robot's own logs.
class OwnLog {
 public:
  OwnLog(RecordStore& store, const LogName& name, std::uint32_t epoch) : store_(&store), name_(name), epoch_(epoch) {}

  /// The next version of an entry. nullopt if the store is full; its sequence number otherwise.
  std::optional<std::uint32_t> write(RecordKind kind, std::uint32_t id, const Bytes& body, double now);
  /// Leaves a tombstone, which the next entry of the same id replaces.
  void remove(RecordKind kind, std::uint32_t id, double now);
  /// The lowest id of a kind that is not in use; tombstones are not in use.
  std::uint32_t freeId(RecordKind kind) const;

  RobotId self() const { return name_.origin; }
  const Log* log() const { return static_cast<const RecordStore*>(store_)->find(name_); }
  /// The record's body as it was written last; nullptr if there is none or it was removed.
  const Bytes* body(RecordKind kind, std::uint32_t id) const;

 private:
  RecordStore* store_;
  LogName name_;
  std::uint32_t epoch_;
};

}  // namespace parley

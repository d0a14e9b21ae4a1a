// SPDX-License-Identifier: BSD-3-Clause
#include "own_log.h"

namespace parley {

std::optional<std::uint32_t> OwnLog::write(RecordKind kind, std::uint32_t id, const Bytes& body, double now) {
  const Log* before = log();
  const Record record = nextVersion(before != nullptr ? *before : Log(), kind, id, body, false);
  if (store_->merge(name_, epoch_, record, now) != MergeResult::kNew) return std::nullopt;
  return record.sequence;
}

void OwnLog::remove(RecordKind kind, std::uint32_t id, double now) {
  if (body(kind, id) == nullptr) return;
  store_->merge(name_, epoch_, nextVersion(*log(), kind, id, {}, true), now);
}

std::uint32_t OwnLog::freeId(RecordKind kind) const {
  const Log* own = log();
  if (own == nullptr) return 0;
  std::uint32_t id = 0;
  for (auto name = own->names.lower_bound({kind, 0}); name != own->names.end() && name->first == std::make_pair(kind, id);
       ++name) {
    if (own->records.at(name->second).record.removed) return id;
    ++id;
  }
  return id;
}

const Bytes* OwnLog::body(RecordKind kind, std::uint32_t id) const {
  const Log* own = log();
  const StoredRecord* stored = own != nullptr ? own->find(kind, id) : nullptr;
  return stored == nullptr || stored->record.removed ? nullptr : &stored->record.body;
}

}  // namespace parley

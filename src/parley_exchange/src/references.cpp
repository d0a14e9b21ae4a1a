// SPDX-License-Identifier: BSD-3-Clause
#include "references.h"

#include <algorithm>

#include "body_codec.h"
#include "knowledge.h"

namespace parley {
namespace {

bool isReference(const Record& record) {
  return !record.removed && (record.kind == RecordKind::kContest || record.kind == RecordKind::kEndorsement);
}

}  // namespace

const StoredRecord* currentContour(const RecordStore& store, const ContourName& name) {
  const Log* log = store.find({name.origin, RecordStream::kMap});
  const StoredRecord* stored = log != nullptr ? log->find(RecordKind::kContour, name.id) : nullptr;
  return stored != nullptr && !stored->record.removed && stored->record.sequence == name.sequence ? stored : nullptr;
}

std::vector<References::Target> References::rebuild(const RecordStore& store) {
  std::map<Target, ReferenceList> lists;
  for (const auto& entry : store.logs()) {
    if (entry.first.stream != RecordStream::kMap) continue;
    for (const auto& stored : entry.second.records) {
      if (!isReference(stored.second.record)) continue;
      const auto body = decodeReference(stored.second.record.body);
      const Log* log = body ? store.find({body->origin, RecordStream::kMap}) : nullptr;
      if (log == nullptr || shortEpoch(log->epoch) != body->epoch) continue;
      ReferenceList& list = lists[{body->origin, body->id}];
      const bool endorses = stored.second.record.kind == RecordKind::kEndorsement;
      (endorses ? list.endorsed : list.contested)
          .emplace_back(body->sequence, endorses ? stored.second.written : stored.second.arrived);
    }
  }
  std::vector<Target> changed;
  for (const auto& list : lists) {
    const auto before = lists_.find(list.first);
    if (before == lists_.end() || !(before->second == list.second)) changed.push_back(list.first);
  }
  for (const auto& list : lists_) {
    if (lists.count(list.first) == 0) changed.push_back(list.first);
  }
  lists_ = std::move(lists);
  return changed;
}

const ReferenceList* References::find(const Target& target) const {
  const auto list = lists_.find(target);
  return list == lists_.end() ? nullptr : &list->second;
}

std::optional<double> References::contestOf(const ContourName& name) const {
  std::optional<double> last;
  const ReferenceList* list = find({name.origin, name.id});
  if (list == nullptr) return last;
  for (const auto& contest : list->contested) {
    if (contest.first == name.sequence) last = std::max(last.value_or(contest.second), contest.second);
  }
  return last;
}

int References::endorsements(const ContourName& name) const {
  const ReferenceList* list = find({name.origin, name.id});
  if (list == nullptr) return 0;
  return static_cast<int>(std::count_if(list->endorsed.begin(), list->endorsed.end(),
                                        [&](const auto& endorsement) { return endorsement.first == name.sequence; }));
}

bool References::add(RecordKind kind, const ContourName& name, std::uint32_t epoch, OwnLog& log, double now) {
  for (const auto& own : own_) {
    if (own.first.first == kind && own.second == name) return true;
  }
  const std::uint32_t id = log.freeId(kind);
  const ContourReference reference{name.origin, shortEpoch(epoch), name.id, name.sequence};
  if (!log.write(kind, id, encode(reference), now)) return false;
  own_[{kind, id}] = name;
  return true;
}

bool References::dropOutdated(const RecordStore& store, OwnLog& log, double now) {
  bool any = false;
  for (auto own = own_.begin(); own != own_.end();) {
    if (currentContour(store, own->second) != nullptr) {
      ++own;
      continue;
    }
    log.remove(own->first.first, own->first.second, now);
    own = own_.erase(own);
    any = true;
  }
  return any;
}

}  // namespace parley

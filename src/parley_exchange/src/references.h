// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "own_log.h"
#include "parley_exchange/peer_state.h"

namespace parley {

/// What robots say of one contour of another: who saw through which version, who sees it too.
struct ReferenceList {
  std::vector<std::pair<std::uint32_t, double>> contested;  // version, and when the contest came here [s]
  std::vector<std::pair<std::uint32_t, double>> endorsed;   // version, and when the endorsement was written [s]
};
inline bool operator==(const ReferenceList& a, const ReferenceList& b) {
  return a.contested == b.contested && a.endorsed == b.endorsed;
}

/// Contests and endorsements of all robots by the contour that is meant, and this robot's own ones. A contour's version is
/// off while it is contested; only its origin can write a newer one, so gossip brings nothing back.
class References {
 public:
  /// The origin and id of a contour.
  using Target = std::pair<RobotId, std::uint32_t>;

  /// Reads all logs again; call it when a contest or endorsement changed. Targets whose list changed.
  std::vector<Target> rebuild(const RecordStore& store);

  const ReferenceList* find(const Target& target) const;
  /// When the last contest of this very version came here [s]; nullopt if nobody contests it.
  std::optional<double> contestOf(const ContourName& name) const;
  /// Robots other than this one that endorsed this version. [-]
  int endorsements(const ContourName& name) const;

  /// Writes a contest or endorsement of this robot's own, once for each version. False if the store is full.
  bool add(RecordKind kind, const ContourName& name, std::uint32_t epoch, OwnLog& log, double now);
  /// Removes own ones whose version of a contour is superseded, withdrawn or no longer held. Whether there were any.
  bool dropOutdated(const RecordStore& store, OwnLog& log, double now);

 private:
  std::map<Target, ReferenceList> lists_;
  std::map<std::pair<RecordKind, std::uint32_t>, ContourName> own_;  // by kind and record id
};

/// The contour's current version, tombstones excluded; nullptr if the name is not that of it.
const StoredRecord* currentContour(const RecordStore& store, const ContourName& name);

}  // namespace parley

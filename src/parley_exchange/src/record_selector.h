// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "knowledge.h"
#include "parley_exchange/exchange_options.h"

namespace parley {

/// A robot in reach, as far as it matters for what to send.
struct Neighbour {
  RobotId id = 0;
  const Knowledge* knowledge = nullptr;
  bool confirmed = false;       // its pose is known: it needs no keyframes
  bool told = false;            // it had time to tell what it has
  bool told_of_others = false;  // and of third robots' records
};

/// Picks the records for a packet: those that some neighbour is not known to have and that have not been sent just now,
/// the more urgent kinds and the least sent first, own before others', newest first.
class RecordSelector {
 public:
  RecordSelector(const ExchangeOptions& options, RobotId self) : options_(options), self_(self) {}

  /// Groups that take at most `bytes` of a packet. The records count as sent.
  std::vector<RecordGroup> select(RecordStore& store, const std::vector<Neighbour>& neighbours, std::size_t bytes,
                                  double now) const;

  /// Somebody else sent this record: no hurry to send it again.
  void overheard(StoredRecord& stored, double now) const;
  /// A record of somebody else came: wait a while, not as long as others do, before it is passed on.
  void learned(StoredRecord& stored, RobotId origin, double now) const;

 private:
  struct Candidate;
  std::vector<Candidate> candidates(RecordStore& store, const std::vector<Neighbour>& neighbours, double now) const;
  bool lacks(const Neighbour& neighbour, const LogName& name) const;
  double spacing(int sends) const;

  ExchangeOptions options_;
  RobotId self_;
};

}  // namespace parley

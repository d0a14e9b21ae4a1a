// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "parley_exchange/messages.h"

namespace parley {

/// A set of sequence numbers as ascending intervals that do not touch.
class Coverage {
 public:
  Coverage() = default;
  /// Intervals that ascend; they may touch.
  explicit Coverage(const std::vector<Interval>& intervals);

  /// Both ends included; nothing if last < first.
  void add(std::uint32_t first, std::uint32_t last);
  void add(const Coverage& other);
  /// What lies above `limit` only.
  Coverage above(std::uint32_t limit) const;
  /// Keeps the lowest `count` intervals.
  void limit(std::size_t count);

  bool contains(std::uint32_t number) const;
  /// The interval that holds a number; it must be contained.
  Interval around(std::uint32_t number) const;

  bool empty() const { return intervals_.empty(); }
  const std::vector<Interval>& intervals() const { return intervals_; }
  bool operator==(const Coverage& other) const { return intervals_ == other.intervals_; }

 private:
  std::vector<Interval>::const_iterator find(std::uint32_t number) const;

  std::vector<Interval> intervals_;
};

}  // namespace parley

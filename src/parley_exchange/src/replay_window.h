// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bitset>
#include <cstddef>
#include <cstdint>

namespace parley {

/// Remembers which of the last counters of a sender have been seen.
class ReplayWindow {
 public:
  /// False if it was seen before, or is so old that one cannot tell.
  bool accept(std::uint32_t counter);

  std::uint32_t highest() const { return highest_; }
  /// Share of the last 64 counters, or of as many as there were since the first, that arrived. [-]
  double receivedShare() const;

 private:
  static constexpr std::size_t kSize = 1024;  // [-]

  std::bitset<kSize> seen_;  // bit i: highest - i
  std::uint32_t highest_ = 0;
  std::uint32_t first_ = 0;
};

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

namespace parley {

/// Foretells the next bin of a polar scan from those before it on the same surface. Along a straight wall the inverse of the
/// range is all but linear in the bearing, so a line through the inverses is carried on. Integers alone.
class BinPredictor {
 public:
  /// 1 to 254. Only with a history.
  int predicted() const;
  int history() const { return count_; }
  /// [-] 0 to 2: how far off the last prediction was.
  int roughness() const { return roughness_; }

  /// A hit that was not predicted begins a history; a large error begins a new one.
  void add(int code, int error);
  void begin(int code);
  void clear() { count_ = 0; }

 private:
  static constexpr int kMost = 6;              // [-] bins that a line is drawn through
  std::array<std::int64_t, kMost> inverse_{};  // newest first
  int count_ = 0;                              // [-]
  int roughness_ = 0;                          // [-]
};

}  // namespace parley

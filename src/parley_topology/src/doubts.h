// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "tiled_map.h"

namespace parley {

/// What to do about a goal that nothing leads to as far as is known. Something may have changed where nobody looks: a robot
/// that stood in a door has left it. So what is doubtful is doubted, in growing intervals, and the robot goes and looks.
class Doubts {
 public:
  /// To be called with each answer. `stamp` [s] of the newest scan.
  void consider(TiledMap& map, double stamp, bool is_reachable);

 private:
  std::optional<double> unreachable_since_;  // [s] or since the last doubt
  double patience_ = 2.0;                    // [s]
  int count_ = 0;
};

}  // namespace parley

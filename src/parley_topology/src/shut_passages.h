// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tiled_map.h"

namespace parley {

/// Passages that look wide enough and turned out not to be: a rectangle does not get round every corner that a disc gets round.
/// Each is shut by one cell in its middle until what stands beside it has gone, or nothing else leads to the goal.
class ShutPassages {
 public:
  /// False if nothing stands beside `p_odom` [m], or too many are shut already.
  bool shut(TiledMap& map, const Eigen::Vector2d& p_odom);
  /// Opens those beside which less stands than when they were shut.
  void review(TiledMap& map);
  void openAll(TiledMap& map);

 private:
  struct Passage {
    int x, y;      // cell
    int standing;  // [cells] of own sensing beside it when it was shut
  };
  std::vector<Passage> passages_;
};

}  // namespace parley

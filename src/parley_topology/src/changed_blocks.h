// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "tiled_map.h"

namespace parley {

/// The blocks of the map that changed in an update, for asking which straight ways lead past them.
class ChangedBlocks {
 public:
  /// A change of distances bears on the measures of ways within `influence` [m].
  ChangedBlocks(const TiledMap& map, double influence);

  /// What a change does to a way: nothing, its measures may be others, or it may open or shut.
  enum Bearing : std::uint8_t { kUntouched = 0, kMeasures = 1, kPassage = 2 };
  /// The most that any change does to a way, and the part in which it may shut.
  struct Touch {
    Bearing bearing = kUntouched;
    double from = 1.0, to = 0.0;  // [-] fractions of the way; all that changed is between, if it is a passage
  };
  Touch touchOf(const Eigen::Vector2d& a, const Eigen::Vector2d& b) const;

  /// Places of the tiles that changes bear on, with or without a tile.
  std::vector<Eigen::Vector2i> tiles() const;

  bool empty() const { return touch_.empty(); }

 private:
  /// In which cells all that changed is, with what it bears on.
  CellRect cells() const { return {rect_.x0 * kBlockSize, rect_.y0 * kBlockSize, rect_.x1 * kBlockSize, rect_.y1 * kBlockSize}; }
  std::uint8_t& at(int x, int y) { return touch_[static_cast<std::size_t>((y - rect_.y0) * rect_.width() + x - rect_.x0)]; }
  std::uint8_t at(int x, int y) const { return touch_[static_cast<std::size_t>((y - rect_.y0) * rect_.width() + x - rect_.x0)]; }
  void mark(const Tile& tile, int margin);

  double block_;   // [m] side of a block
  CellRect rect_;  // in blocks
  std::vector<std::uint8_t> touch_;
};

}  // namespace parley

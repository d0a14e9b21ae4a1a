// SPDX-License-Identifier: BSD-3-Clause
#include "changed_blocks.h"

#include <limits>

namespace parley {
namespace {

constexpr int kBlocksPerTile = kTileSize / kBlockSize;

}  // namespace

ChangedBlocks::ChangedBlocks(const TiledMap& map, double influence) : block_(map.resolution() * kBlockSize) {
  const int margin = static_cast<int>(std::ceil(influence / block_));
  bool any = false;
  for (const Tile* tile : map.changed()) {
    const int x0 = tile->tx * kBlocksPerTile, y0 = tile->ty * kBlocksPerTile;
    const CellRect blocks = CellRect{x0, y0, x0 + kBlocksPerTile, y0 + kBlocksPerTile}.grown(margin);
    rect_ = any ? rect_.united(blocks) : blocks;
    any = true;
  }
  if (!any) return;
  touch_.assign(static_cast<std::size_t>(rect_.width()) * static_cast<std::size_t>(rect_.height()), kUntouched);
  for (const Tile* tile : map.changed()) mark(*tile, margin);
}

void ChangedBlocks::mark(const Tile& tile, int margin) {
  for (int block = 0; block < kBlocksPerTile * kBlocksPerTile; ++block) {
    const int x = tile.tx * kBlocksPerTile + block % kBlocksPerTile, y = tile.ty * kBlocksPerTile + block / kBlocksPerTile;
    const unsigned bit = 1U << block;
    const int spread = tile.changed_field & bit ? margin : 0;
    for (int dy = -spread; (tile.changed_seen | tile.changed_field) & bit && dy <= spread; ++dy) {
      for (int dx = -spread; dx <= spread; ++dx) at(x + dx, y + dy) = std::max<std::uint8_t>(at(x + dx, y + dy), kMeasures);
    }
    if (tile.changed_passable & bit) at(x, y) = kPassage;
  }
}

ChangedBlocks::Touch ChangedBlocks::touchOf(const Eigen::Vector2d& a, const Eigen::Vector2d& b) const {
  const double low[2] = {static_cast<double>(rect_.x0), static_cast<double>(rect_.y0)};
  const double high[2] = {static_cast<double>(rect_.x1), static_cast<double>(rect_.y1)};
  double enter = 0.0, leave = 1.0;  // the part of the way within the rectangle, as fractions
  double next[2], step[2];          // fractions at which the next line between blocks is crossed, and between such lines
  const Eigen::Vector2d from = a / block_, way = (b - a) / block_;
  for (int k = 0; k < 2; ++k) {
    if (std::abs(way[k]) < 1e-12) {
      if (from[k] < low[k] || from[k] >= high[k]) return kUntouched;
      continue;
    }
    const double t0 = (low[k] - from[k]) / way[k], t1 = (high[k] - from[k]) / way[k];
    enter = std::max(enter, std::min(t0, t1));
    leave = std::min(leave, std::max(t0, t1));
  }
  if (enter > leave) return kUntouched;
  int cell[2], sign[2];
  for (int k = 0; k < 2; ++k) {
    const double at_entry = from[k] + enter * way[k];
    cell[k] = std::clamp(static_cast<int>(std::floor(at_entry)), static_cast<int>(low[k]), static_cast<int>(high[k]) - 1);
    sign[k] = way[k] > 0.0 ? 1 : -1;
    const bool still = std::abs(way[k]) < 1e-12;
    step[k] = still ? std::numeric_limits<double>::infinity() : 1.0 / std::abs(way[k]);
    next[k] = still ? step[k] : (cell[k] + (sign[k] > 0 ? 1 : 0) - from[k]) / way[k];
  }
  Touch touch = kUntouched;
  while (cell[0] >= rect_.x0 && cell[0] < rect_.x1 && cell[1] >= rect_.y0 && cell[1] < rect_.y1) {
    touch = std::max(touch, static_cast<Touch>(at(cell[0], cell[1])));
    const int k = next[0] < next[1] ? 0 : 1;
    if (touch == kPassage || next[k] > leave) return touch;
    cell[k] += sign[k];
    next[k] += step[k];
  }
  return touch;
}

}  // namespace parley

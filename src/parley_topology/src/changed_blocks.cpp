// SPDX-License-Identifier: BSD-3-Clause
#include "changed_blocks.h"

#include "square_walk.h"

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
  const Eigen::Vector2d from = a / block_, way = (b - a) / block_;
  for (int k = 0; k < 2; ++k) {
    if (std::abs(way[k]) < 1e-12) {
      if (from[k] < low[k] || from[k] >= high[k]) return {};
      continue;
    }
    const double t0 = (low[k] - from[k]) / way[k], t1 = (high[k] - from[k]) / way[k];
    enter = std::max(enter, std::min(t0, t1));
    leave = std::min(leave, std::max(t0, t1));
  }
  if (enter > leave) return {};
  SquareWalk walk(from, way, enter, rect_);
  Touch touch;
  double entered = enter;
  do {
    const bool inside = walk.x() >= rect_.x0 && walk.x() < rect_.x1 && walk.y() >= rect_.y0 && walk.y() < rect_.y1;
    if (!inside) break;
    const double left = walk.leavesAt();
    const auto bearing = static_cast<Bearing>(at(walk.x(), walk.y()));
    touch.bearing = std::max(touch.bearing, bearing);
    if (bearing == kPassage) {
      touch.from = std::min(touch.from, entered);
      touch.to = std::min(left, 1.0);
    }
    entered = left;
  } while (walk.advance(leave));
  return touch;
}

std::vector<Eigen::Vector2i> ChangedBlocks::tiles() const {
  std::vector<Eigen::Vector2i> tiles;
  forEachTile(cells(), [&](int tx, int ty, const CellRect& part) {
    bool any = false;
    for (int y = part.y0 / kBlockSize; y < part.y1 / kBlockSize && !any; ++y) {
      for (int x = part.x0 / kBlockSize; x < part.x1 / kBlockSize && !any; ++x) any = at(x, y) != kUntouched;
    }
    if (any) tiles.emplace_back(tx, ty);
  });
  return tiles;
}

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#include "tiled_map.h"

#include <limits>

namespace parley {

bool operator==(const Chain& a, const Chain& b) {
  return a.closed == b.closed && a.turn == b.turn && a.before == b.before && a.first == b.first && a.last == b.last &&
         a.end == b.end && a.points == b.points;
}

TiledMap::TiledMap(double resolution, double extent, int max_tiles)
    : resolution_(resolution),
      inverse_(1.0 / resolution),
      extent_(extent),
      half_(static_cast<int>(std::ceil(extent / (resolution * kTileSize))) + 1),
      side_(static_cast<unsigned>(2 * half_)),
      max_tiles_(static_cast<std::size_t>(max_tiles)),
      directory_(static_cast<std::size_t>(side_) * side_, nullptr) {}

Tile* TiledMap::ensure(int tx, int ty) {
  const auto ix = static_cast<unsigned>(tx + half_), iy = static_cast<unsigned>(ty + half_);
  if (ix >= side_ || iy >= side_) {
    saturated_ = true;
    return nullptr;
  }
  Tile*& place = directory_[iy * side_ + ix];
  if (place) return place;
  if (tiles_.size() >= max_tiles_) {
    saturated_ = true;
    return nullptr;
  }
  tiles_.push_back(std::make_unique<Tile>());
  place = tiles_.back().get();
  place->tx = tx;
  place->ty = ty;
  place->flags.fill(kFlagsOfNothing);
  place->distance.fill(kFarAway);
  return place;
}

std::uint16_t TiledMap::secondsOf(double stamp) {
  constexpr double kBefore = 3600.0;  // [s]
  if (!(stamp > std::numeric_limits<double>::lowest())) return 0;
  if (!epoch_) epoch_ = stamp - kBefore;
  return static_cast<std::uint16_t>(std::clamp(stamp - *epoch_, 0.0, 65535.0));
}

void TiledMap::shut(int x, int y) {
  Tile* tile = ensure(tileOf(x), tileOf(y));
  if (!tile || isShut(x, y)) return;
  shut_.emplace_back(x, y);
  tile->changed_cells = static_cast<std::uint16_t>(tile->changed_cells | blockBit(x, y));
  note(*tile);
}

void TiledMap::open(int x, int y) {
  shut_.erase(std::remove(shut_.begin(), shut_.end(), Eigen::Vector2i(x, y)), shut_.end());
  Tile* tile = find(tileOf(x), tileOf(y));
  if (!tile) return;
  tile->changed_cells = static_cast<std::uint16_t>(tile->changed_cells | blockBit(x, y));
  note(*tile);
}

void TiledMap::forgetCell(Tile& tile, int x, int y) {
  const std::size_t i = offsetOf(x, y);
  tile.flags[i] = static_cast<std::uint8_t>(tile.flags[i] & ~(kSeen | kOwn));
  tile.evidence[i] = 0;
  tile.looked[i] = 0;
  const std::uint16_t block = blockBit(x, y);
  tile.changed_cells = static_cast<std::uint16_t>(tile.changed_cells | block);
  tile.changed_seen = static_cast<std::uint16_t>(tile.changed_seen | block);
  note(tile);
}

void TiledMap::forgetChanges() {
  for (Tile* tile : changed_) {
    tile->changed_cells = tile->changed_seen = tile->changed_field = tile->changed_passable = 0;
    tile->noted = false;
  }
  changed_.clear();
}

void TiledMap::clear() {
  changed_.clear();
  tiles_.clear();
  std::fill(directory_.begin(), directory_.end(), nullptr);
  saturated_ = false;
  doubted_ = 0;
  shut_.clear();
  epoch_.reset();
}

}  // namespace parley

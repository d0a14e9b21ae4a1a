// SPDX-License-Identifier: BSD-3-Clause
#include "doubts.h"

namespace parley {
namespace {

constexpr double kMostPatience = 60.0;  // [s]
constexpr int kInView = 2;              // [s] what was looked at since then is not doubted

void noteAll(TiledMap& map, Tile& tile, std::uint16_t blocks) {
  tile.changed_cells = static_cast<std::uint16_t>(tile.changed_cells | blocks);
  tile.changed_seen = static_cast<std::uint16_t>(tile.changed_seen | blocks);
  map.note(tile);
}

/// What stands where own sensing once saw nothing, and is out of view, may have gone again: back to never seen.
void doubtOwn(TiledMap& map, int now) {
  for (const auto& tile : map.tiles()) {
    std::uint16_t blocks = 0;
    for (int y = 0; y < kTileSize; ++y) {
      for (int x = 0; x < kTileSize; ++x) {
        const std::size_t i = offsetOf(x, y);
        if ((tile->flags[i] & kCame) != kCame || tile->looked[i] + kInView > now) continue;
        tile->flags[i] = static_cast<std::uint8_t>(tile->flags[i] & ~(kSeen | kOwn));
        tile->evidence[i] = 0;
        tile->looked[i] = 0;
        blocks = static_cast<std::uint16_t>(blocks | blockBit(x, y));
      }
    }
    if (blocks) noteAll(map, *tile, blocks);
  }
}

/// Peers' outlines told until now count no longer.
void doubtPeers(TiledMap& map, std::uint16_t now) {
  map.setDoubted(now);
  for (const auto& tile : map.tiles()) {
    if (tile->layers) noteAll(map, *tile, 0xffff);
  }
}

}  // namespace

void Doubts::consider(TiledMap& map, double stamp, bool is_reachable) {
  if (is_reachable) {
    unreachable_since_.reset();
    return;
  }
  if (!unreachable_since_) unreachable_since_ = stamp;
  if (stamp - *unreachable_since_ < patience_) return;
  unreachable_since_ = stamp;
  patience_ = std::min(2.0 * patience_, kMostPatience);
  const std::uint16_t now = map.secondsOf(stamp);
  doubtOwn(map, now);
  if (++count_ > 1) doubtPeers(map, now);
}

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#include "doubts.h"

namespace parley {
namespace {

constexpr double kMostPatience = 60.0;  // [s]
constexpr int kInView = 2;              // [s] what was looked at since then is not doubted

/// What stands where own sensing once saw nothing, and is out of view, may have gone again: back to never seen.
void doubtOwn(TiledMap& map, int now) {
  for (const auto& tile : map.tiles()) {
    for (int y = 0; y < kTileSize; ++y) {
      for (int x = 0; x < kTileSize; ++x) {
        const std::size_t i = offsetOf(x, y);
        if ((tile->flags[i] & kCame) == kCame && tile->looked[i] + kInView <= now) map.forgetCell(*tile, x, y);
      }
    }
  }
}

/// Peers' outlines told until now count no longer.
void doubtPeers(TiledMap& map, std::uint16_t now) {
  map.setDoubted(now);
  for (const auto& tile : map.tiles()) {
    if (!tile->layers) continue;
    tile->changed_cells = tile->changed_seen = 0xffff;
    map.note(*tile);
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

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "changed_blocks.h"
#include "tiled_map.h"

namespace parley {

/// Which open pairs lead through which tile place, so that a change is told to those alone. Entries of pairs that have moved
/// on stay until they are met.
class PassIndex {
 public:
  explicit PassIndex(double resolution) : side_(resolution * kTileSize) {}

  /// Notes an entry in all tile places along the way. `is_void(entry)` tells which entries can go.
  template <class IsVoid>
  void add(const Watch& entry, const Eigen::Vector2d& a, const Eigen::Vector2d& b, const IsVoid& is_void) {
    for (const std::uint64_t place : placesAlong(a, b)) lists_[place].add(entry, is_void);
  }

  /// Pairs of all entries in places that a change bears on, each once, in rising order.
  template <class IsVoid>
  std::vector<int> pairsAt(const ChangedBlocks& changed, const IsVoid& is_void) {
    std::vector<int> pairs;
    for (const Eigen::Vector2i& place : changed.tiles()) {
      const auto found = lists_.find(keyOf(place.x(), place.y()));
      if (found == lists_.end()) continue;
      found->second.sweep(is_void);
      for (const Watch& entry : found->second.entries) pairs.push_back(entry.pair);
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
  }

 private:
  static std::uint64_t keyOf(int tx, int ty) {
    return static_cast<std::uint64_t>(static_cast<std::uint32_t>(tx)) << 32 | static_cast<std::uint32_t>(ty);
  }
  std::vector<std::uint64_t> placesAlong(const Eigen::Vector2d& a, const Eigen::Vector2d& b) const;

  double side_;  // [m] of a tile
  std::unordered_map<std::uint64_t, WatchList> lists_;
};

}  // namespace parley

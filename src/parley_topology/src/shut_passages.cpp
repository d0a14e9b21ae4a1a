// SPDX-License-Identifier: BSD-3-Clause
#include "shut_passages.h"

namespace parley {
namespace {

constexpr double kBeside = 0.5;         // [m] what stands nearer than this makes it narrow
constexpr double kGone = 0.6;           // [-] of what stood there when it was shut is left, at most: something has gone
constexpr std::size_t kMostShut = 100;  // [-]

int standingBeside(const TiledMap& map, int x, int y) {
  const int reach = static_cast<int>(std::ceil(kBeside / map.resolution()));
  int standing = 0;
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) standing += map.flags(x + dx, y + dy) & kOwn ? 1 : 0;
  }
  return standing;
}

}  // namespace

bool ShutPassages::shut(TiledMap& map, const Eigen::Vector2d& p_odom) {
  if (map.isOutside(p_odom) || passages_.size() >= kMostShut) return false;
  const Passage passage{map.cellOf(p_odom.x()), map.cellOf(p_odom.y()),
                        standingBeside(map, map.cellOf(p_odom.x()), map.cellOf(p_odom.y()))};
  if (passage.standing == 0 || map.isShut(passage.x, passage.y)) return false;
  map.shut(passage.x, passage.y);
  passages_.push_back(passage);
  return true;
}

void ShutPassages::review(TiledMap& map) {
  const auto has_gone = [&map](const Passage& passage) {
    return standingBeside(map, passage.x, passage.y) < kGone * passage.standing;
  };
  for (const Passage& passage : passages_) {
    if (has_gone(passage)) map.open(passage.x, passage.y);
  }
  passages_.erase(std::remove_if(passages_.begin(), passages_.end(), has_gone), passages_.end());
}

void ShutPassages::openAll(TiledMap& map) {
  for (const Passage& passage : passages_) map.open(passage.x, passage.y);
  passages_.clear();
}

}  // namespace parley

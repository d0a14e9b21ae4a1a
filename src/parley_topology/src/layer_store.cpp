// SPDX-License-Identifier: BSD-3-Clause
#include "layer_store.h"

#include <iterator>

namespace parley {
namespace {

constexpr std::int64_t kOffset = std::int64_t{1} << 31;

std::uint64_t keyOf(int x, int y) {
  return (static_cast<std::uint64_t>(y + kOffset) << 32) | static_cast<std::uint64_t>(x + kOffset);
}
int xOf(std::uint64_t key) { return static_cast<int>(static_cast<std::int64_t>(key & 0xffffffffU) - kOffset); }
int yOf(std::uint64_t key) { return static_cast<int>(static_cast<std::int64_t>(key >> 32) - kOffset); }

void sortUnique(std::vector<std::uint64_t>& keys) {
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
}

/// Leaves out cells whose tile cannot be had.
void keepMapped(TiledMap& map, std::vector<std::uint64_t>& keys) {
  const auto homeless = [&map](std::uint64_t key) { return !map.ensure(tileOf(xOf(key)), tileOf(yOf(key))); };
  keys.erase(std::remove_if(keys.begin(), keys.end(), homeless), keys.end());
}

/// Adds `step` to the layer counts of cells, all of which have a tile. A count stays below 256 because the number of layers is
/// bounded.
void addToCounts(TiledMap& map, const std::vector<std::uint64_t>& cells, bool hard, int step) {
  for (const std::uint64_t key : cells) {
    const int x = xOf(key), y = yOf(key);
    Tile* tile = map.find(tileOf(x), tileOf(y));
    if (!tile->layers) tile->layers = std::make_unique<LayerCounts>();
    std::uint8_t& count = (hard ? tile->layers->hard : tile->layers->soft)[offsetOf(x, y)];
    count = static_cast<std::uint8_t>(count + step);
    const std::uint16_t block = blockBit(x, y);
    tile->changed_cells = static_cast<std::uint16_t>(tile->changed_cells | block);
    tile->changed_seen = static_cast<std::uint16_t>(tile->changed_seen | block);
    map.note(*tile);
  }
}

/// What is in `a` and not in `b`, both sorted.
std::vector<std::uint64_t> difference(const std::vector<std::uint64_t>& a, const std::vector<std::uint64_t>& b) {
  std::vector<std::uint64_t> only;
  std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(only));
  return only;
}

bool sameOutlines(const LayerUpdate& a, const LayerUpdate& b) {
  const auto same = [](const LayerContour& c, const LayerContour& d) { return c.closed == d.closed && c.polygon == d.polygon; };
  return a.T_odom_peer == b.T_odom_peer && a.obstacle == b.obstacle &&
         std::equal(a.contours.begin(), a.contours.end(), b.contours.begin(), b.contours.end(), same);
}

}  // namespace

std::vector<std::uint64_t> LayerStore::draw(const TiledMap& map, const LayerUpdate& layer) {
  const double step = 0.5 * map.resolution();
  const int spread = layer.obstacle ? 0 : static_cast<int>(std::ceil(reach_ / map.resolution()));
  const auto limit = static_cast<std::size_t>(options_.max_layer_cells);
  std::vector<std::uint64_t> keys;
  const auto stamp = [&](const Eigen::Vector2d& p) {
    const int cx = map.cellOf(p.x()), cy = map.cellOf(p.y());
    for (int dy = -spread; dy <= spread; ++dy) {
      for (int dx = -spread; dx <= spread; ++dx) {
        if (dx * dx + dy * dy <= spread * spread) keys.push_back(keyOf(cx + dx, cy + dy));
      }
    }
    if (keys.size() > 2 * limit) sortUnique(keys);
  };
  const std::size_t contours = std::min(layer.contours.size(), static_cast<std::size_t>(options_.max_layer_contours));
  saturated_ = saturated_ || contours < layer.contours.size();
  for (std::size_t c = 0; c < contours; ++c) {
    const Polygon polygon = transformed(layer.T_odom_peer, layer.contours[c].polygon);
    const bool usable = std::none_of(polygon.begin(), polygon.end(), [&](const auto& p) { return map.isOutside(p); });
    const std::size_t segments = polygon.size() < 2 || layer.contours[c].closed ? polygon.size() : polygon.size() - 1;
    for (std::size_t i = 0; usable && i < segments && keys.size() <= 2 * limit; ++i) {
      const Eigen::Vector2d& a = polygon[i];
      const Eigen::Vector2d& b = polygon[(i + 1) % polygon.size()];
      const int steps = std::max(1, static_cast<int>(std::ceil((b - a).norm() / step)));
      for (int k = 0; k <= steps && keys.size() <= 2 * limit; ++k) stamp(a + (b - a) * (static_cast<double>(k) / steps));
    }
  }
  sortUnique(keys);
  saturated_ = saturated_ || keys.size() > limit;
  keys.resize(std::min(keys.size(), limit));
  return keys;
}

bool LayerStore::set(TiledMap& map, const LayerUpdate& layer) {
  if (layer.origin.empty() || !layer.T_odom_peer.isFinite()) return false;
  const auto held = layers_.find(layer.origin);
  if (held == layers_.end() && count() >= std::min(options_.max_layers, 255)) {
    saturated_ = true;
    return false;
  }
  const Provenance provenance{layer.origin, layer.hops, layer.stamp};
  if (held != layers_.end() && sameOutlines(held->second.update, layer)) {
    held->second.provenance = provenance;
    return true;
  }
  Layer drawn{layer, provenance, draw(map, layer)};
  keepMapped(map, drawn.cells);
  const bool comparable =
      held != layers_.end() && held->second.update.obstacle == layer.obstacle && held->second.provenance.hops == layer.hops;
  if (!comparable) {
    remove(map, layer.origin);
    addToCounts(map, drawn.cells, layer.obstacle, 1);
    layers_.emplace(layer.origin, std::move(drawn));
    return true;
  }
  const std::vector<std::uint64_t>& before = held->second.cells;
  addToCounts(map, difference(before, drawn.cells), layer.obstacle, -1);
  addToCounts(map, difference(drawn.cells, before), layer.obstacle, 1);
  held->second = std::move(drawn);
  return true;
}

bool LayerStore::remove(TiledMap& map, const std::string& origin) {
  const auto held = layers_.find(origin);
  if (held == layers_.end()) return false;
  addToCounts(map, held->second.cells, held->second.update.obstacle, -1);
  layers_.erase(held);
  return true;
}

const Provenance* LayerStore::ownerOf(int x, int y) const {
  const Provenance* owner = nullptr;
  const std::uint64_t key = keyOf(x, y);
  for (const auto& [origin, layer] : layers_) {
    if (!layer.update.obstacle || (owner && owner->hops <= layer.provenance.hops)) continue;
    if (std::binary_search(layer.cells.begin(), layer.cells.end(), key)) owner = &layer.provenance;
  }
  return owner;
}

}  // namespace parley

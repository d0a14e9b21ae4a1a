// SPDX-License-Identifier: BSD-3-Clause
#include "layer_store.h"

#include <iterator>

namespace parley {
namespace {

constexpr int kPlaceBits = 26;  // of a tile's column or row, which an offset keeps above zero
constexpr int kTileShift = 2 * kTileBits;
constexpr std::uint64_t kPlaceMask = (std::uint64_t{1} << kPlaceBits) - 1;

std::uint64_t placeBits(int tile) {
  return static_cast<std::uint64_t>(tile + (std::int64_t{1} << (kPlaceBits - 1))) & kPlaceMask;
}
int tileOfBits(std::uint64_t bits) {
  return static_cast<int>(static_cast<std::int64_t>(bits & kPlaceMask) - (std::int64_t{1} << (kPlaceBits - 1)));
}

/// Orders cells by tile and by row in it.
std::uint64_t keyOf(int x, int y) {
  return (placeBits(tileOf(y)) << (kPlaceBits + kTileShift)) | (placeBits(tileOf(x)) << kTileShift) | offsetOf(x, y);
}
int xOf(std::uint64_t key) { return tileOfBits(key >> kTileShift) * kTileSize + static_cast<int>(key & (kTileSize - 1)); }
int yOf(std::uint64_t key) {
  return tileOfBits(key >> (kTileShift + kPlaceBits)) * kTileSize + static_cast<int>((key >> kTileBits) & (kTileSize - 1));
}

/// Cells, each once with the newest time it came with.
class CellSet {
 public:
  void add(int x, int y, std::uint16_t told) {
    const std::uint64_t key = keyOf(x, y), tile = key >> kTileShift;
    if (tile_ == nullptr || tile != last_) {
      tile_ = &tiles_.try_emplace(tile, kTileCells, kNone).first->second;
      last_ = tile;
    }
    std::int32_t& held = (*tile_)[offsetOf(x, y)];
    count_ += held == kNone ? 1 : 0;
    held = std::max(held, static_cast<std::int32_t>(told));
  }
  std::size_t count() const { return count_; }

  /// By key.
  std::vector<LayerCell> cells() const {
    std::vector<LayerCell> result;
    result.reserve(count_);
    for (const auto& [tile, told] : tiles_) {
      for (std::size_t i = 0; i < told.size(); ++i) {
        if (told[i] != kNone) result.push_back({(tile << kTileShift) | i, static_cast<std::uint16_t>(told[i])});
      }
    }
    return result;
  }

 private:
  static constexpr std::int32_t kNone = -1;
  std::map<std::uint64_t, std::vector<std::int32_t>> tiles_;
  std::vector<std::int32_t>* tile_ = nullptr;
  std::uint64_t last_ = 0;
  std::size_t count_ = 0;
};

/// Leaves out cells whose tile cannot be had.
void keepMapped(TiledMap& map, std::vector<LayerCell>& cells) {
  const auto homeless = [&map](const LayerCell& c) { return !map.ensure(tileOf(xOf(c.key)), tileOf(yOf(c.key))); };
  cells.erase(std::remove_if(cells.begin(), cells.end(), homeless), cells.end());
}

/// Changes the counts of a cell, which has a tile, and notes its block. A count stays below 256 because the number of layers
/// is bounded.
template <class Change>
void change(TiledMap& map, std::uint64_t key, const Change& apply) {
  const int x = xOf(key), y = yOf(key);
  Tile* tile = map.find(tileOf(x), tileOf(y));
  if (!tile->layers) tile->layers = std::make_unique<LayerCounts>();
  apply(*tile->layers, offsetOf(x, y));
  const std::uint16_t block = blockBit(x, y);
  tile->changed_cells = static_cast<std::uint16_t>(tile->changed_cells | block);
  tile->changed_seen = static_cast<std::uint16_t>(tile->changed_seen | block);
  map.note(*tile);
}

void putIn(TiledMap& map, const std::vector<LayerCell>& cells, bool hard) {
  for (const LayerCell& cell : cells) {
    change(map, cell.key, [&](LayerCounts& counts, std::size_t i) {
      ++(hard ? counts.hard : counts.soft)[i];
      if (hard) counts.told[i] = std::max(counts.told[i], cell.told);
    });
  }
}

/// What is in `a` and not in `b`, both sorted.
std::vector<LayerCell> difference(const std::vector<LayerCell>& a, const std::vector<LayerCell>& b) {
  std::vector<LayerCell> only;
  std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(only));
  return only;
}

const LayerCell* find(const std::vector<LayerCell>& cells, std::uint64_t key) {
  const auto place =
      std::lower_bound(cells.begin(), cells.end(), key, [](const LayerCell& c, std::uint64_t k) { return c.key < k; });
  return place != cells.end() && place->key == key ? &*place : nullptr;
}

bool sameOutlines(const LayerUpdate& a, const LayerUpdate& b) {
  const auto same = [](const LayerContour& c, const LayerContour& d) {
    return c.closed == d.closed && c.stamp == d.stamp && c.polygon == d.polygon && c.id == d.id && c.version == d.version;
  };
  return a.T_odom_peer == b.T_odom_peer && a.obstacle == b.obstacle &&
         std::equal(a.contours.begin(), a.contours.end(), b.contours.begin(), b.contours.end(), same);
}

}  // namespace

std::vector<LayerCell> LayerStore::draw(TiledMap& map, const LayerUpdate& layer) {
  const double step = 0.5 * map.resolution();
  const int spread = layer.obstacle ? 0 : static_cast<int>(std::ceil(reach_ / map.resolution()));
  const auto limit = static_cast<std::size_t>(options_.max_layer_cells);
  CellSet drawn;
  std::uint16_t told = 0;
  const auto stamp = [&](const Eigen::Vector2d& p) {
    const int cx = map.cellOf(p.x()), cy = map.cellOf(p.y());
    for (int dy = -spread; dy <= spread; ++dy) {
      for (int dx = -spread; dx <= spread; ++dx) {
        if (dx * dx + dy * dy <= spread * spread) drawn.add(cx + dx, cy + dy, told);
      }
    }
  };
  const std::size_t contours = std::min(layer.contours.size(), static_cast<std::size_t>(options_.max_layer_contours));
  saturated_ = saturated_ || contours < layer.contours.size();
  for (std::size_t c = 0; c < contours; ++c) {
    const Polygon polygon = transformed(layer.T_odom_peer, layer.contours[c].polygon);
    told = map.secondsOf(layer.contours[c].stamp);
    const bool usable = std::none_of(polygon.begin(), polygon.end(), [&](const auto& p) { return map.isOutside(p); });
    const std::size_t segments = polygon.size() < 2 || layer.contours[c].closed ? polygon.size() : polygon.size() - 1;
    for (std::size_t i = 0; usable && i < segments && drawn.count() <= limit; ++i) {
      const Eigen::Vector2d& a = polygon[i];
      const Eigen::Vector2d& b = polygon[(i + 1) % polygon.size()];
      const int steps = std::max(1, static_cast<int>(std::ceil((b - a).norm() / step)));
      for (int k = 0; k <= steps && drawn.count() <= limit; ++k) stamp(a + (b - a) * (static_cast<double>(k) / steps));
    }
  }
  std::vector<LayerCell> cells = drawn.cells();
  saturated_ = saturated_ || cells.size() > limit;
  cells.resize(std::min(cells.size(), limit));
  return cells;
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
    putIn(map, drawn.cells, layer.obstacle);
    layers_.emplace(layer.origin, std::move(drawn));
    return true;
  }
  takeOut(map, difference(held->second.cells, drawn.cells), held->second);
  putIn(map, difference(drawn.cells, held->second.cells), layer.obstacle);
  held->second = std::move(drawn);
  return true;
}

/// Takes cells of a held layer out of the counts; what is left in them is as the other layers have it.
void LayerStore::takeOut(TiledMap& map, const std::vector<LayerCell>& cells, const Layer& layer) {
  const bool hard = layer.update.obstacle;
  for (const LayerCell& cell : cells) {
    change(map, cell.key, [&](LayerCounts& counts, std::size_t i) {
      --(hard ? counts.hard : counts.soft)[i];
      if (!hard) return;
      counts.told[i] = 0;
      for (const auto& [origin, other] : layers_) {
        if (&other == &layer || !other.update.obstacle) continue;
        if (const LayerCell* left = find(other.cells, cell.key)) counts.told[i] = std::max(counts.told[i], left->told);
      }
    });
  }
}

bool LayerStore::remove(TiledMap& map, const std::string& origin) {
  const auto held = layers_.find(origin);
  if (held == layers_.end()) return false;
  takeOut(map, held->second.cells, held->second);
  layers_.erase(held);
  return true;
}

std::vector<const LayerUpdate*> LayerStore::updates() const {
  std::vector<const LayerUpdate*> updates;
  for (const auto& [origin, layer] : layers_) updates.push_back(&layer.update);
  return updates;
}

const Provenance* LayerStore::ownerOf(int x, int y) const {
  const Provenance* owner = nullptr;
  const std::uint64_t key = keyOf(x, y);
  for (const auto& [origin, layer] : layers_) {
    if (!layer.update.obstacle || (owner && owner->hops <= layer.provenance.hops)) continue;
    if (find(layer.cells, key)) owner = &layer.provenance;
  }
  return owner;
}

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "parley_topology/visibility_graph.h"

namespace parley {

constexpr int kTileBits = 6;
constexpr int kTileSize = 1 << kTileBits;  // [cells]
constexpr int kTileCells = kTileSize * kTileSize;
constexpr int kBlockBits = 4;                // changes are noted by blocks of 16 by 16 cells, so that a tile's fit into 16 bits
constexpr int kBlockSize = 1 << kBlockBits;  // [cells]

/// Bits of what is known of a cell.
enum CellFlag : std::uint8_t {
  kSeen = 1,        // own sensing has looked at it
  kOwn = 2,         // own sensing holds it occupied
  kFused = 4,       // occupied, by own sensing or by a layer where own sensing has not looked
  kWide = 8,        // further than the grown radius from what is occupied: contours bound this
  kPassable = 16,   // within a cell of what is wide: edges may lead here
  kTentative = 32,  // within reach of an outline that does not block
  kOnceFree = 64    // own sensing was sure that nothing is here, or saw what may move here, now or earlier
};

/// What stands where own sensing was once sure of nothing that stays: it came, and may go.
constexpr std::uint8_t kCame = kOwn | kOnceFree;

/// What holds where there is no tile: never seen, nothing near.
constexpr std::uint8_t kFlagsOfNothing = kWide | kPassable;
constexpr std::uint8_t kFarAway = 255;

/// Half-open rectangle of cells.
struct CellRect {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;

  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
  bool empty() const { return x1 <= x0 || y1 <= y0; }
  CellRect grown(int cells) const { return {x0 - cells, y0 - cells, x1 + cells, y1 + cells}; }
  CellRect united(const CellRect& o) const {
    return {std::min(x0, o.x0), std::min(y0, o.y0), std::max(x1, o.x1), std::max(y1, o.y1)};
  }
  CellRect clipped(const CellRect& o) const {
    return {std::max(x0, o.x0), std::max(y0, o.y0), std::min(x1, o.x1), std::min(y1, o.y1)};
  }
};

/// The part of a contour of the grown obstacles that lies in one tile. An open chain ends in the first point that is
/// outside the tile, with which the chain of that tile begins.
struct Chain {
  std::vector<Eigen::Vector2d> points;  // [m] simplified, odom frame
  bool closed = false;
  int turn = 0;  // sign of the turns at convex corners of the obstacle: 1 if it lies to the left of the way along the points
  Eigen::Vector2i before = Eigen::Vector2i::Zero();  // cell of the pixel before the first, open chains only
  Eigen::Vector2i first = Eigen::Vector2i::Zero();   // cell of the first pixel
  Eigen::Vector2i last = Eigen::Vector2i::Zero();    // cell of the last pixel inside the tile
  Eigen::Vector2i end = Eigen::Vector2i::Zero();     // cell of the first pixel outside
  Eigen::Vector2d core = Eigen::Vector2d::Zero();    // [m] a point of the obstacle it goes around
};

bool operator==(const Chain& a, const Chain& b);

/// How many layers cover a cell; only tiles under a layer have it.
struct LayerCounts {
  std::array<std::uint8_t, kTileCells> hard{};
  std::array<std::uint8_t, kTileCells> soft{};
  std::array<std::uint16_t, kTileCells> told{};  // [s] of the map's clock, when the newest hard one was told
};

/// An entry of a list of vertex pairs; void once the pair's version has moved on.
struct Watch {
  int pair = 0;
  std::uint32_t version = 0;
};

/// A list whose void entries are thrown out now and then, so that whoever makes an entry void need not look for it.
struct WatchList {
  std::vector<Watch> entries;
  std::size_t after_sweep = 0;

  template <class IsVoid>
  void sweep(const IsVoid& is_void) {
    entries.erase(std::remove_if(entries.begin(), entries.end(), is_void), entries.end());
    after_sweep = entries.size();
  }
  template <class IsVoid>
  void add(const Watch& entry, const IsVoid& is_void) {
    if (entries.size() > 2 * after_sweep + 64) sweep(is_void);
    entries.push_back(entry);
  }
};

/// A square of the map with all that is derived from it. Bits of the `changed_` masks are blocks, row-major.
struct Tile {
  int tx = 0, ty = 0;
  std::array<std::int8_t, kTileCells> evidence{};
  std::array<std::uint8_t, kTileCells> flags{};
  std::array<std::uint8_t, kTileCells> distance{};  // to what is fused occupied, kFarAway is the field's reach
  std::array<std::uint16_t, kTileCells> looked{};   // [s] of the map's clock, when own sensing last said something; 0 is never
  std::unique_ptr<LayerCounts> layers;
  std::uint16_t changed_cells = 0;     // what is occupied, or seen with layers about: the field has to be worked out again
  std::uint16_t changed_seen = 0;      // what is seen or tentative: measures of edges across it
  std::uint16_t changed_field = 0;     // distances and what follows from them: contours, and measures of edges near by
  std::uint16_t changed_passable = 0;  // of these, where edges open or shut
  std::vector<Chain> chains;
  std::vector<int> vertices;  // slots
  WatchList watches;          // pairs that a cell in here keeps shut
  bool noted = false;         // in the map's list of changed tiles

  CellRect rect() const { return {tx * kTileSize, ty * kTileSize, (tx + 1) * kTileSize, (ty + 1) * kTileSize}; }
};

inline int tileOf(int cell) { return cell >> kTileBits; }
inline std::size_t offsetOf(int x, int y) {
  return static_cast<std::size_t>(((y & (kTileSize - 1)) << kTileBits) | (x & (kTileSize - 1)));
}
inline std::uint16_t blockBit(int x, int y) {
  return static_cast<std::uint16_t>(1U << ((((y & (kTileSize - 1)) >> kBlockBits) << 2) | ((x & (kTileSize - 1)) >> kBlockBits)));
}

/// The map: tiles that come into being where something was seen, in any direction, up to a bound.
class TiledMap {
 public:
  TiledMap(double resolution, double extent, int max_tiles);

  double resolution() const { return resolution_; }
  int cellOf(double coordinate) const { return static_cast<int>(std::floor(coordinate * inverse_)); }
  double centerOf(int cell) const { return (cell + 0.5) * resolution_; }
  Eigen::Vector2d centerOf(int x, int y) const { return {centerOf(x), centerOf(y)}; }

  const Tile* find(int tx, int ty) const {
    const auto ix = static_cast<unsigned>(tx + half_), iy = static_cast<unsigned>(ty + half_);
    return ix < side_ && iy < side_ ? directory_[iy * side_ + ix] : nullptr;
  }
  Tile* find(int tx, int ty) { return const_cast<Tile*>(static_cast<const TiledMap*>(this)->find(tx, ty)); }

  /// Makes the tile if need be; nullptr outside the extent or at the bound, which is noted.
  Tile* ensure(int tx, int ty);

  std::uint8_t flags(int x, int y) const {
    const Tile* tile = find(tileOf(x), tileOf(y));
    return tile ? tile->flags[offsetOf(x, y)] : kFlagsOfNothing;
  }
  std::uint8_t distance(int x, int y) const {
    const Tile* tile = find(tileOf(x), tileOf(y));
    return tile ? tile->distance[offsetOf(x, y)] : kFarAway;
  }

  /// Seconds of a clock that began an hour before the first stamp asked for; 0 for what is older, and after 18 hours it
  /// stands still.
  std::uint16_t secondsOf(double stamp);

  /// A passage that turned out too narrow to drive is shut as if something stood there, whatever own sensing says.
  void shut(int x, int y);
  void open(int x, int y);
  bool isShut(int x, int y) const {
    const auto here = [&](const Eigen::Vector2i& cell) { return cell.x() == x && cell.y() == y; };
    return !shut_.empty() && std::any_of(shut_.begin(), shut_.end(), here);
  }

  /// Layers' outlines told until then [s of the map's clock] are not believed; 0 if all are.
  std::uint16_t doubted() const { return doubted_; }
  void setDoubted(std::uint16_t second) { doubted_ = second; }

  /// Puts a tile on the list of changed ones, whose `changed_` masks are looked at in the next update.
  void note(Tile& tile) {
    if (!tile.noted) changed_.push_back(&tile);
    tile.noted = true;
  }
  /// Own sensing says nothing of a cell of a tile any longer, as if it had never been seen.
  void forgetCell(Tile& tile, int x, int y);
  const std::vector<Tile*>& changed() const { return changed_; }
  /// Clears the list and the masks.
  void forgetChanges();

  /// In the order in which they came.
  const std::vector<std::unique_ptr<Tile>>& tiles() const { return tiles_; }
  bool saturated() const { return saturated_; }
  /// Whether coordinates are so far out that they are not mapped. Also true for NaN.
  bool isOutside(const Eigen::Vector2d& p) const { return !(std::abs(p.x()) < extent_ && std::abs(p.y()) < extent_); }
  void clear();

 private:
  double resolution_;
  double inverse_;
  double extent_;
  int half_;
  unsigned side_;
  std::size_t max_tiles_;
  bool saturated_ = false;
  std::uint16_t doubted_ = 0;
  std::vector<Eigen::Vector2i> shut_;
  std::optional<double> epoch_;  // [s] when the map's clock began
  std::vector<Tile*> directory_;
  std::vector<std::unique_ptr<Tile>> tiles_;
  std::vector<Tile*> changed_;
};

/// Calls visit(tx, ty, part) for every tile place that a rectangle of cells overlaps, row by row.
template <class Visit>
void forEachTile(const CellRect& rect, const Visit& visit) {
  if (rect.empty()) return;
  for (int ty = tileOf(rect.y0); ty <= tileOf(rect.y1 - 1); ++ty) {
    for (int tx = tileOf(rect.x0); tx <= tileOf(rect.x1 - 1); ++tx) {
      const CellRect tile{tx * kTileSize, ty * kTileSize, (tx + 1) * kTileSize, (ty + 1) * kTileSize};
      visit(tx, ty, rect.clipped(tile));
    }
  }
}

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#include "clearance_field.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "parley_geometry/squared_distances.h"

namespace parley {
namespace {

constexpr double kSameThing = 0.3;  // [m] outlines this near to own ones are theirs, with the pose's error
constexpr int kNewer = 2;           // [s] by which an outline must be newer than the look it overrules

CellRect changedRect(const Tile& tile) {
  CellRect rect{kTileSize, kTileSize, 0, 0};
  for (int block = 0; block < 16; ++block) {
    if (!(tile.changed_cells & (1U << block))) continue;
    const int x = (block & 3) * kBlockSize, y = (block >> 2) * kBlockSize;
    rect = rect.united({x, y, x + kBlockSize, y + kBlockSize});
  }
  const int x0 = tile.tx * kTileSize, y0 = tile.ty * kTileSize;
  return {rect.x0 + x0, rect.y0 + y0, rect.x1 + x0, rect.y1 + y0};
}

/// The changed blocks of each tile, which are no longer noted as changed.
std::vector<CellRect> takeChanged(const TiledMap& map) {
  std::vector<CellRect> rects;
  for (Tile* tile : map.changed()) {
    if (tile->changed_cells) rects.push_back(changedRect(*tile));
    tile->changed_cells = 0;
  }
  return rects;
}

double areaOf(const CellRect& rect) { return static_cast<double>(rect.width()) * rect.height(); }

/// Joins windows as long as working on the joint one, grown by `halo`, is no more work than on both.
std::vector<CellRect> joined(const std::vector<CellRect>& rects, int halo) {
  std::vector<CellRect> windows;
  for (CellRect rect : rects) {
    for (std::size_t i = 0; i < windows.size();) {
      const CellRect both = rect.united(windows[i]);
      if (areaOf(both.grown(halo)) <= areaOf(rect.grown(halo)) + areaOf(windows[i].grown(halo))) {
        rect = both;
        windows.erase(windows.begin() + static_cast<std::ptrdiff_t>(i));
        i = 0;
      } else {
        ++i;
      }
    }
    windows.push_back(rect);
  }
  return windows;
}

/// A picture of a window: value(tile, offset) of every cell, `nothing` where there is no tile.
template <class Pixel, class Value>
cv::Mat_<Pixel> picture(const TiledMap& map, const CellRect& rect, Pixel nothing, const Value& value) {
  cv::Mat_<Pixel> image(rect.height(), rect.width(), nothing);
  forEachTile(rect, [&](int tx, int ty, const CellRect& part) {
    const Tile* tile = map.find(tx, ty);
    if (!tile) return;
    for (int y = part.y0; y < part.y1; ++y) {
      Pixel* out = image[y - rect.y0] + (part.x0 - rect.x0);
      const std::size_t first = offsetOf(part.x0, y);
      for (std::size_t i = 0; i < static_cast<std::size_t>(part.width()); ++i) out[i] = value(*tile, first + i);
    }
  });
  return image;
}

bool hasLayers(const TiledMap& map, const CellRect& rect) {
  bool any = false;
  forEachTile(rect, [&](int tx, int ty, const CellRect&) {
    const Tile* tile = map.find(tx, ty);
    any = any || (tile && tile->layers);
  });
  return any;
}

void setBit(std::uint8_t& flags, std::uint8_t bit, bool on) {
  flags = static_cast<std::uint8_t>(on ? flags | bit : flags & ~bit);
}

/// When own sensing last looked at or right beside each cell of a window, in the map's seconds; 0 where it has not seen.
cv::Mat1w timesLooked(const TiledMap& map, const CellRect& rect, int gap) {
  const CellRect around = rect.grown(gap);
  const auto seen = [](const Tile& tile, std::size_t i) -> std::uint16_t {
    return tile.flags[i] & kSeen ? std::max<std::uint16_t>(1, tile.looked[i]) : std::uint16_t{0};
  };
  cv::Mat1w looked = picture<std::uint16_t>(map, around, 0, seen);
  cv::dilate(looked, looked, cv::Mat(), cv::Point(-1, -1), gap);
  return looked(cv::Rect(gap, gap, rect.width(), rect.height()));
}

/// Where something of own sensing is so near that a layer's outline may mean the same thing.
cv::Mat1b nearOwn(const TiledMap& map, const CellRect& rect) {
  const int reach = static_cast<int>(std::lround(kSameThing / map.resolution()));
  const auto own = [](const Tile& tile, std::size_t i) -> std::uint8_t { return tile.flags[i] & kOwn ? 255 : 0; };
  cv::Mat1b near = picture<std::uint8_t>(map, rect.grown(reach), 0, own);
  cv::dilate(near, near, cv::Mat(), cv::Point(-1, -1), reach);
  return near(cv::Rect(reach, reach, rect.width(), rect.height()));
}

/// Own sensing where it has looked and up to the layer distance around, layers beyond. Where it saw nothing, now or near by,
/// an outline that was told later has the word. Leaves the blocks in `changed_cells` of which something is occupied or free now
/// that was not.
void fuse(TiledMap& map, const CellRect& rect, const FieldShape& shape) {
  cv::Mat1w looked;
  cv::Mat1b near_own;
  if (hasLayers(map, rect)) {
    looked = timesLooked(map, rect, static_cast<int>(std::lround(shape.layer_distance / map.resolution())));
    near_own = nearOwn(map, rect);
  }
  const int doubted = map.doubted();
  const auto ownWord = [&](const Tile& tile, std::size_t i, int row, int column) {
    if (!tile.layers || tile.layers->told[i] < doubted) return true;
    if (looked(row, column) == 0) return false;
    return near_own(row, column) || tile.layers->told[i] <= looked(row, column) + kNewer;
  };
  forEachTile(rect, [&](int tx, int ty, const CellRect& part) {
    Tile* tile = map.find(tx, ty);
    if (!tile) return;
    for (int y = part.y0; y < part.y1; ++y) {
      for (int x = part.x0; x < part.x1; ++x) {
        const std::size_t i = offsetOf(x, y);
        std::uint8_t& flags = tile->flags[i];
        const std::uint8_t before = flags;
        const bool own_word = ownWord(*tile, i, y - rect.y0, x - rect.x0);
        setBit(flags, kFused, (flags & kOwn) || (!own_word && tile->layers->hard[i] > 0) || map.isShut(x, y));
        setBit(flags, kTentative, !own_word && tile->layers->soft[i] > 0);
        if ((before ^ flags) & kFused) tile->changed_cells = static_cast<std::uint16_t>(tile->changed_cells | blockBit(x, y));
      }
    }
    if (tile->changed_cells) map.note(*tile);
  });
}

/// Distances and what follows from them, for a window; `wide` and `passable` as 0 or 255.
struct FieldImage {
  CellRect rect;
  cv::Mat1b distance, wide, passable;
};

/// By square [cells^2] up to that of `reach`, which is far away, the distance as a tile holds it, `scale` for each cell.
std::vector<std::uint8_t> heldDistances(int reach, double scale) {
  std::vector<std::uint8_t> held(static_cast<std::size_t>(reach * reach + 1));
  for (std::size_t square = 0; square < held.size(); ++square) {
    held[square] = cv::saturate_cast<std::uint8_t>(scale * std::sqrt(static_cast<double>(square)));
  }
  held.back() = kFarAway;
  return held;
}

FieldImage measure(const TiledMap& map, const CellRect& rect, const FieldShape& shape) {
  const int halo = static_cast<int>(std::ceil(shape.reach / map.resolution())) + 1;
  const int reach = std::min(halo, kMostReach);
  const auto is_fused = [](const Tile& tile, std::size_t i) -> std::uint8_t { return tile.flags[i] & kFused; };
  const CellRect around = rect.grown(halo + 1);
  const cv::Mat1b fused = picture<std::uint8_t>(map, around, 0, is_fused);
  const std::vector<std::int16_t> squares =
      squaredDistances({fused.begin(), fused.end()}, around.width(), around.height(), reach);
  const std::vector<std::uint8_t> held = heldDistances(reach, kFarAway * map.resolution() / shape.reach);

  FieldImage image;
  image.rect = rect;
  image.distance.create(rect.height() + 2, rect.width() + 2);  // a cell more to each side, to dilate
  for (int y = 0; y < image.distance.rows; ++y) {
    const auto row = squares.begin() + static_cast<std::ptrdiff_t>(y + halo) * around.width() + halo;
    std::transform(row, row + image.distance.cols, image.distance[y],
                   [&](std::int16_t square) { return held[static_cast<std::size_t>(square)]; });
  }
  image.wide = image.distance >= shape.grown_radius / shape.reach * kFarAway;
  cv::dilate(image.wide, image.passable, cv::getStructuringElement(cv::MORPH_RECT, {3, 3}));
  const cv::Rect core(1, 1, rect.width(), rect.height());
  image.distance = image.distance(core);
  image.wide = image.wide(core);
  image.passable = image.passable(core);
  return image;
}

bool isFar(const FieldImage& image, const CellRect& part) {
  const cv::Rect inside(part.x0 - image.rect.x0, part.y0 - image.rect.y0, part.width(), part.height());
  const cv::Mat1b distance = image.distance(inside);
  double least = kFarAway;
  cv::minMaxLoc(distance, &least, nullptr);
  return least >= kFarAway;
}

void store(TiledMap& map, const FieldImage& image) {
  forEachTile(image.rect, [&](int tx, int ty, const CellRect& part) {
    Tile* tile = map.find(tx, ty);
    if (!tile && !isFar(image, part)) tile = map.ensure(tx, ty);
    if (!tile) return;
    const std::uint16_t before = tile->changed_field;
    for (int y = part.y0; y < part.y1; ++y) {
      const int row = y - image.rect.y0;
      for (int x = part.x0; x < part.x1; ++x) {
        const int column = x - image.rect.x0;
        const std::size_t i = offsetOf(x, y);
        std::uint8_t flags = tile->flags[i];
        setBit(flags, kWide, image.wide(row, column));
        setBit(flags, kPassable, image.passable(row, column));
        const std::uint8_t distance = image.distance(row, column);
        if (flags == tile->flags[i] && distance == tile->distance[i]) continue;
        const std::uint16_t block = blockBit(x, y);
        tile->changed_field = static_cast<std::uint16_t>(tile->changed_field | block);
        if ((flags ^ tile->flags[i]) & kPassable)
          tile->changed_passable = static_cast<std::uint16_t>(tile->changed_passable | block);
        tile->flags[i] = flags;
        tile->distance[i] = distance;
      }
    }
    if (tile->changed_field != before) map.note(*tile);
  });
}

}  // namespace

void refreshField(TiledMap& map, const FieldShape& shape) {
  const int gap = static_cast<int>(std::lround(shape.layer_distance / map.resolution()));
  const int halo = static_cast<int>(std::ceil(shape.reach / map.resolution()));
  for (const CellRect& window : joined(takeChanged(map), 2 * gap)) fuse(map, window.grown(gap), shape);
  for (const CellRect& window : joined(takeChanged(map), 2 * halo)) store(map, measure(map, window.grown(halo), shape));
}

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#include "map_outlines.h"

#include <opencv2/imgproc.hpp>

namespace parley {
namespace {

constexpr double kTolerance = 0.8;  // [cells] of the simplification

std::vector<Contour> tileOutlines(const TiledMap& map, const Tile& tile, CellFlag flag) {
  cv::Mat1b image(kTileSize, kTileSize);
  for (int i = 0; i < kTileCells; ++i)
    image(i >> kTileBits, i & (kTileSize - 1)) = tile.flags[static_cast<std::size_t>(i)] & flag ? 255 : 0;
  std::vector<std::vector<cv::Point>> outlines;
  std::vector<cv::Vec4i> hierarchy;
  cv::findContours(image, outlines, hierarchy, cv::RETR_CCOMP, cv::CHAIN_APPROX_NONE);
  std::vector<Contour> contours;
  for (std::size_t i = 0; i < outlines.size(); ++i) {
    std::vector<cv::Point> simple;
    cv::approxPolyDP(outlines[i], simple, kTolerance, true);
    Contour contour;
    contour.closed = simple.size() > 2;  // what is one cell thick is a line, there and back
    contour.hole = contour.closed && hierarchy[i][3] >= 0;
    contour.tile = {tile.tx, tile.ty};
    contour.piece = static_cast<int>(contours.size());
    for (const cv::Point& p : simple)
      contour.polygon.push_back(map.centerOf(tile.tx * kTileSize + p.x, tile.ty * kTileSize + p.y));
    if (contour.polygon.size() == 1) contour.polygon.push_back(contour.polygon[0] + Eigen::Vector2d(0.5 * map.resolution(), 0.0));
    contours.push_back(std::move(contour));
  }
  return contours;
}

}  // namespace

std::vector<Contour> outlinesOf(const TiledMap& map, CellFlag flag) {
  std::vector<const Tile*> tiles;
  for (const auto& tile : map.tiles()) tiles.push_back(tile.get());
  std::sort(tiles.begin(), tiles.end(),
            [](const Tile* a, const Tile* b) { return a->ty != b->ty ? a->ty < b->ty : a->tx < b->tx; });
  std::vector<Contour> contours;
  for (const Tile* tile : tiles) {
    for (Contour& contour : tileOutlines(map, *tile, flag)) contours.push_back(std::move(contour));
  }
  return contours;
}

}  // namespace parley

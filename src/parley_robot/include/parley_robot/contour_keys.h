// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "parley_topology/contour.h"

namespace parley {

/// Names for the pieces of outlines that are told to others. Topology counts the pieces of a tile from its first row on, so that
/// a new one shifts the numbers of those behind it; here the shape decides, and whoever has not changed keeps its name.
class ContourKeys {
 public:
  /// One key for each contour, none twice. Those of the last call are kept by the contours that are as they were, then by the
  /// nearest ones in the same tile.
  std::vector<std::int64_t> assign(const std::vector<Contour>& contours);

 private:
  using Tile = std::pair<int, int>;
  struct Named {
    std::int64_t key = 0;
    Contour contour;
    bool taken = false;
  };
  static Tile tileOf(const Contour& contour) { return {contour.tile.x(), contour.tile.y()}; }
  Named* nearest(const Contour& contour);

  std::map<Tile, std::vector<Named>> last_;
  std::int64_t next_ = 0;
};

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "parley_geometry/polygon.h"
#include "parley_geometry/pose2.h"

namespace parley {

/// A piece of an obstacle's outline in the odom frame. Outlines are cut at the borders of the map's tiles, so that a
/// change in one place leaves all other pieces as they were.
struct Contour {
  Polygon polygon;                                 // [m] corners in order
  bool hole = false;                               // closed, and the obstacle is around it rather than inside
  bool closed = false;                             // the last corner is joined to the first
  Eigen::Vector2i tile = Eigen::Vector2i::Zero();  // [-] the tile it lies in: with `piece` a name that stays
  int piece = 0;                                   // [-] counts within the tile
};

/// An outline as a peer tells it, in that peer's frame.
struct LayerContour {
  Polygon polygon;  // [m]
  bool closed = false;
  double stamp = std::numeric_limits<double>::lowest();  // [s] when it was last stood by, this robot's clock; lowest: nobody said
  std::uint32_t id = 0;                                  // [-] with its version a name at its origin
  std::uint32_t version = 0;                             // [-]
};

/// Names an outline of a layer that own sensing has seen through since it was told.
struct SeenThrough {
  std::string origin;
  std::uint32_t id = 0;       // [-]
  std::uint32_t version = 0;  // [-]
};

/// An outline, in the odom frame, that is known to be wrong for what was seen before a time.
struct Refuted {
  Polygon polygon;  // [m]
  bool closed = false;
  double before = 0.0;  // [s] this robot's clock
};

/// Who says so.
struct Provenance {
  std::string origin;  // robot that saw it; empty is own sensing
  int hops = 0;        // [-] robots it went through, 0 is own sensing
  double stamp = 0.0;  // [s] when it was last confirmed, this robot's clock
};

/// All that is held of one origin's outlines, with where that origin's frame is believed to be.
struct LayerUpdate {
  std::string origin;
  int hops = 1;          // [-]
  double stamp = 0.0;    // [s]
  Pose2 T_odom_peer;     // of the frame the outlines are given in
  bool obstacle = true;  // outlines block; otherwise (pose not confirmed) they only make crossing them dearer
  std::vector<LayerContour> contours;
};

}  // namespace parley

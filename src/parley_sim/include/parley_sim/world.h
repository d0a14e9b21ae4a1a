// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "parley_geometry/grid_frame.h"
#include "parley_sim/shapes.h"

namespace parley::sim {

/// The walls: a grid of solid and free squares, solid all around. Knows how far it is to the next wall.
class World {
 public:
  /// `solid`: frame.width * frame.height values, row-major from the bottom, 0 is free.
  World(const GridFrame& frame, const std::vector<std::uint8_t>& solid);

  const GridFrame& frame() const { return frame_; }
  /// Any cell may be asked; what is outside the grid is solid.
  bool isSolid(const Eigen::Vector2i& cell) const { return cellGap(cell) == 0.0F; }
  bool isSolid(const Eigen::Vector2d& point) const { return isSolid(frame_.cellOf(point)); }

  /// From a cell's centre to the nearest solid cell's centre, in cells; 0 in what is solid.
  float cellGap(const Eigen::Vector2i& cell) const { return frame_.contains(cell) ? gaps_[gapIndex(cell.x(), cell.y())] : 0.0F; }
  /// A bound that is cheap: nothing solid is nearer to the point than this. [m]
  double freeRadius(const Eigen::Vector2d& point) const;
  /// Distance to the nearest solid square, exact where it is below `limit`, otherwise `limit`. [m]
  double distanceToSolid(const Eigen::Vector2d& point, double limit) const;
  double distanceToSolid(const Box& box, double limit) const;
  bool overlapsSolid(const Box& box) const;

  /// Distance along the unit vector `direction` to the first solid square; +inf beyond `max_range`. [m]
  double castRay(const Eigen::Vector2d& origin, const Eigen::Vector2d& direction, double max_range) const;
  /// No wall between two points.
  bool inSight(const Eigen::Vector2d& a, const Eigen::Vector2d& b) const;

 private:
  std::size_t gapIndex(int x, int y) const {
    return static_cast<std::size_t>(y + 1) * static_cast<std::size_t>(frame_.width + 2) + static_cast<std::size_t>(x + 1);
  }
  Box squareOf(int x, int y) const;

  GridFrame frame_;
  std::vector<float> gaps_;  // with a border of one solid cell, so that no ray leaves the grid
};

}  // namespace parley::sim

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace parley {

/// Places a grid in a frame: cell (0, 0) has its lower left corner at `origin`; x to the right, y up, row-major from the bottom.
struct GridFrame {
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();  // [m]
  double resolution = 0.05;                          // [m] a cell's side
  int width = 0;                                     // [cells]
  int height = 0;                                    // [cells]

  /// The cell a point falls in, which may lie outside the grid.
  Eigen::Vector2i cellOf(const Eigen::Vector2d& p) const {
    return {static_cast<int>(std::floor((p.x() - origin.x()) / resolution)),
            static_cast<int>(std::floor((p.y() - origin.y()) / resolution))};
  }
  Eigen::Vector2d centerOf(const Eigen::Vector2i& cell) const {
    return {origin.x() + (cell.x() + 0.5) * resolution, origin.y() + (cell.y() + 0.5) * resolution};
  }
  bool contains(const Eigen::Vector2i& cell) const {
    return cell.x() >= 0 && cell.y() >= 0 && cell.x() < width && cell.y() < height;
  }
  int indexOf(const Eigen::Vector2i& cell) const { return cell.y() * width + cell.x(); }
  Eigen::Vector2d size() const { return {width * resolution, height * resolution}; }
};

inline bool operator==(const GridFrame& a, const GridFrame& b) {
  return a.origin == b.origin && a.resolution == b.resolution && a.width == b.width && a.height == b.height;
}

}  // namespace parley

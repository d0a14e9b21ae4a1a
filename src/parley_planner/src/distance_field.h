// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "parley_geometry/grid_frame.h"

namespace parley {

/// Distance from anywhere in a window to the nearest marked cell's centre, interpolated between cells, up to 2 m: what is
/// farther is as far as that.
class DistanceField {
 public:
  struct Sample {
    double distance = 0.0;                               // [m]
    Eigen::Vector2d gradient = Eigen::Vector2d::Zero();  // [-] away from what is near
  };

  DistanceField() = default;
  /// `marked`: frame.width * frame.height, non-zero where there is something.
  DistanceField(const GridFrame& frame, const std::vector<unsigned char>& marked);

  bool empty() const { return distances_.empty(); }
  const GridFrame& frame() const { return frame_; }
  /// [m] bilinear; outside the window that of the nearest border cell.
  double at(const Eigen::Vector2d& p) const;
  Sample sample(const Eigen::Vector2d& p) const;
  /// [m] at a cell's centre; the cell must be in the window.
  float atCell(int x, int y) const { return distances_[static_cast<std::size_t>(y * frame_.width + x)]; }

 private:
  GridFrame frame_;
  std::vector<float> distances_;  // [m]
};

}  // namespace parley

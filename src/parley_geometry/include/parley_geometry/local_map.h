// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "parley_geometry/grid_frame.h"
#include "parley_geometry/pose2.h"

namespace parley {

/// What is known of a place. `kSeenFree` is own sensing only: a peer's word never makes a place free.
enum class CellState : std::uint8_t { kUnknown = 0, kSeenFree = 1, kOccupied = 2 };

/// A window of the map around the robot, in its odom frame: what the local planner plans on.
struct LocalMap {
  double stamp = 0.0;  // [s] of the newest scan in it
  GridFrame frame;
  std::vector<CellState> cells;  // frame.width * frame.height, row-major from the bottom

  bool empty() const { return cells.empty(); }
  /// Outside the window nothing is known.
  CellState at(const Eigen::Vector2i& cell) const {
    return frame.contains(cell) ? cells[static_cast<std::size_t>(frame.indexOf(cell))] : CellState::kUnknown;
  }
  CellState at(const Eigen::Vector2d& p_odom) const { return at(frame.cellOf(p_odom)); }
};

/// Finite frame, positive resolution, as many cells as the frame says: to check maps that come from outside.
bool isConsistent(const LocalMap& map);

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "parley_geometry/footprint.h"
#include "parley_geometry/scan.h"
#include "tiled_map.h"

namespace parley {

/// What a scan says of a cell. A greater one wins over a lesser one.
enum ScanMark : std::uint8_t { kNothing = 0, kClear = 1, kKeep = 2, kPassing = 3, kUnderRobot = 4, kHit = 5 };

/// A scan drawn as an image of marks whose first pixel is the cell (x0, y0).
struct ScanImage {
  cv::Mat1b marks;
  CellRect rect;
  bool empty() const { return marks.empty(); }
};

/// A scan that can be used: some bins, a finite range, origin and pose.
bool isUsable(const ObstacleScan& scan, const Pose2& T_odom_base);

/// Draws a scan. Clear: the polygon of the rays' ends, each `clear_margin` [m] short of its hit. Kept as it is: the line
/// between neighbouring hits on one surface, lest rays that graze a wall erase it. Passing: where rays end on what moves or may.
/// Hit: where rays end on the rest.
ScanImage drawScan(const ObstacleScan& scan, const Pose2& T_odom_base, const Footprint& footprint, double clear_margin,
                   double resolution);

}  // namespace parley

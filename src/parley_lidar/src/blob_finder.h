// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "binned_scan.h"
#include "parley_geometry/scan.h"
#include "parley_lidar/lidar_options.h"

namespace parley {

/// A blob with the returns it is made of.
struct BlobShape {
  Blob blob;
  double depth = 0.0;                   // [m] along the line of sight
  double radius = 0.0;                  // [m] of a disc around its middle that covers the returns
  std::vector<Eigen::Vector2d> points;  // [m] base frame, clockwise side first
};

/// Groups of neighbouring returns, nearer by a jump than what is seen on both sides of them, neither too narrow nor too
/// wide. What is cut off by something nearer, by the view's edge or by the end of the lidar's range is no blob: the
/// middle of what is left of it would wander with the view.
std::vector<BlobShape> findBlobs(const BinnedScan& scan, const LidarOptions& options);

}  // namespace parley

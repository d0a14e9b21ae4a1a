// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "binned_scan.h"
#include "parley_geometry/footprint.h"
#include "parley_geometry/scan.h"
#include "scan_motion.h"

namespace parley {

/// Latest time of a point that is finite and within [0, max_duration]. [s]
double durationOf(const LidarCloud& cloud, const LidarOptions& options);

/// Sorts a spatial lidar's returns by bearing: obstacles are what is in the height band and not the robot itself.
/// A bin within the lidar's view is free up to its nearest obstacle, unless nothing but the robot itself was seen there.
BinnedScan binCloud(const LidarCloud& cloud, const ScanMotion& motion, const LidarOptions& options, const Footprint& footprint,
                    const LidarMount& mount);

}  // namespace parley

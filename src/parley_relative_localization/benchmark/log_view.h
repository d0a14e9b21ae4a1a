// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "carmen_log.h"
#include "study.h"

namespace parley::study {

/// What one or two scans of a log show from a place between theirs, in the bins of an ObstacleScan.
struct LogView {
  Pose2 T_map_base;
  std::vector<float> ranges;   // [m] to the surface; +inf where there is none in reach, NaN where no scan looked
  std::vector<float> seen_to;  // [m] up to which a scan saw free space
};

/// A ray ends at the first surface of a scan that saw all of the way to it. Where that is hidden from both, nothing is known.
/// Surfaces farther than `reach` [m] are none.
LogView viewFrom(const Pose2& T_map_base, const std::vector<const LogScan*>& scans, int bins, double reach);

/// The view as the lidar stage would give it, with bodies painted in where it saw free space up to them, and the blobs.
/// Ranges of the log keep their own noise; those of bodies get the lidar's.
ObstacleScan paintedScan(const LogView& view, const std::vector<test::Body>& bodies, double stamp, const test::LidarModel& lidar,
                         std::mt19937& random);

}  // namespace parley::study

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scan_history.h"

namespace parley {

/// Takes out returns that stand alone: dust, rain, the edge of a thing mixed with what is behind it. To lose an obstacle
/// is worse than to see a ghost, so a return stays if another beam, or an earlier scan, was there too: a post so thin
/// that one beam meets it is late by one scan. A bin falls back to its second nearest return, else it was not looked at.
BinnedScan withoutOutliers(BinnedScan scan, const Pose2& T_odom_base, const ScanHistory& history, double stamp, double distance,
                           double memory);

}  // namespace parley

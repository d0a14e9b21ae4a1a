// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "object_tracker.h"

namespace parley {

/// Counts the points on a thing that prove it moved between two sightings: points of the old one that the newest scan sees
/// through, and points of the new one that the old one's scan saw through. A still thing has neither, however much of it
/// came into view or left it as the robot drove by: a ray to a point on its surface ends there, or on a nearer part of it.
/// That holds for things no thinner than the gap between two beams, so where beams lie far apart nothing is proved.
int motionEvidence(const Sighting& before, const Sighting& now, const ScanHistory& history, const LidarOptions& options);

/// Against one of its earlier sightings the track was displaced, fast enough, and there is evidence.
bool hasMoved(const Track& track, const ScanHistory& history, const LidarOptions& options);

}  // namespace parley

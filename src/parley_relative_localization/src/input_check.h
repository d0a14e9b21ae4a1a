// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "parley_geometry/scan.h"
#include "parley_relative_localization/exchange_records.h"

namespace parley {

// Whether data from outside can be what it claims to be: finite, and within what robots and buildings are like.
bool isPlausible(const Pose2& pose);
bool isPlausible(const Footprint& footprint);
bool isPlausible(const ObstacleScan& scan);
bool isPlausible(const MotionReport& motion);
bool isPlausible(const SightReport& report);
bool isPlausible(const Keyframe& keyframe);
bool isPlausible(const RelativeEdge& edge);

}  // namespace parley

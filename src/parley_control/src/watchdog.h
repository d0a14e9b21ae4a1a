// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "parley_control/controller.h"

namespace parley {

/// Why the robot may not drive, whatever the trajectory says: an input is missing, too old or not a number, or the
/// planner says stop. The worst first: odometry, lidar, planner.
std::optional<Status<DriveState>> reasonToStop(const ControlRequest& request, const ControlOptions& options);

}  // namespace parley

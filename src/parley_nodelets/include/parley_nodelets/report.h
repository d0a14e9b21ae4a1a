// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>

#include "parley_nodelets/odometry_input.h"

namespace parley {

using Report = diagnostic_updater::DiagnosticStatusWrapper;

/// What a node got of odometry; a warning if there is none at present or it comes in other frames than the node's.
void reportOdometry(Report& report, const OdometrySnapshot& odometry, const Frames& frames, double now);

}  // namespace parley

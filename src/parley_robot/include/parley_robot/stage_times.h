// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "parley_geometry/timed.h"

namespace parley {

/// Wall time that each stage took in one step [s], negative where it did not run. `local_plan` contains `trajectory`.
/// For reports only: nothing a robot does depends on it.
struct StageTimes {
  double lidar = -1.0;
  double map_fusion = -1.0;
  double topology = -1.0;
  double route = -1.0;
  double relative_localization = -1.0;
  double local_plan = -1.0;
  double trajectory = -1.0;
  double control = -1.0;
};

}  // namespace parley

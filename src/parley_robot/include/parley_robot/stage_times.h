// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>

namespace parley {

/// Wall time that each stage took in one step [s], negative where it did not run. For reports only: nothing a robot does
/// depends on it.
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

/// Runs a stage and returns how long it took. [s]
template <class Work>
double timed(Work&& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace parley

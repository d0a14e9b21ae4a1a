// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>

namespace parley {

/// Runs some work and returns how long it took by the computer's clock [s]. For reports only: nothing a robot does may depend
/// on it.
template <class Work>
double timed(Work&& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace parley

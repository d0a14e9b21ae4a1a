// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>

namespace parley {

/// An expected failure: a code of the stage's own enum and a sentence for people.
template <class Code>
struct Status {
  Code code{};
  std::string text;

  Status() = default;
  Status(Code c, std::string t = {}) : code(c), text(std::move(t)) {}
  bool is(Code c) const { return code == c; }
};

/// Why a robot does what it does; the controller has the last word. Names are those of traces and results.
enum class DriveState {
  kDriving,
  kWaiting,
  kYielding,
  kEscaping,
  kBlocked,
  kArrived,
  kNoRoute,
  kNoLidar,
  kNoOdometry,
  kStopped,
  kDead
};

constexpr const char* toString(DriveState state) {
  constexpr const char* kNames[] = {"driving",  "waiting",  "yielding",    "escaping", "blocked", "arrived",
                                    "no_route", "no_lidar", "no_odometry", "stopped",  "dead"};
  return kNames[static_cast<int>(state)];
}

}  // namespace parley

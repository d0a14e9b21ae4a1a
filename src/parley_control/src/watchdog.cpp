// SPDX-License-Identifier: BSD-3-Clause
#include "watchdog.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "twist_limits.h"

namespace parley {
namespace {

using Stop = std::optional<Status<DriveState>>;

/// A stamp from the future counts as wrong too: it would keep a dead input alive.
bool isFresh(double now, double stamp, double timeout) { return std::abs(now - stamp) <= timeout; }

std::string ageText(const char* what, double now, double stamp) {
  char text[96];
  const double age = now - stamp;
  std::snprintf(text, sizeof(text), "%s is %.2f s %s", what, std::abs(age), age >= 0.0 ? "old" : "ahead of the clock");
  return text;
}

Stop odometryFault(const ControlRequest& request, const ControlOptions& options) {
  const Odometry* odometry = request.odometry;
  if (odometry == nullptr) return {{DriveState::kNoOdometry, "no odometry yet"}};
  if (!std::isfinite(odometry->stamp) || !odometry->pose.isFinite() || !isFinite(odometry->twist)) {
    return {{DriveState::kNoOdometry, "odometry is not finite"}};
  }
  if (isFresh(request.now, odometry->stamp, options.odometry_timeout)) return std::nullopt;
  return {{DriveState::kNoOdometry, ageText("odometry", request.now, odometry->stamp)}};
}

Stop lidarFault(const ControlRequest& request, const ControlOptions& options) {
  const ObstacleScan* scan = request.scan;
  if (scan == nullptr) return {{DriveState::kNoLidar, "no scan yet"}};
  if (!std::isfinite(scan->stamp) || !scan->origin.allFinite() || !request.T_odom_scan.isFinite()) {
    return {{DriveState::kNoLidar, "scan is not finite"}};
  }
  const bool blind = std::all_of(scan->ranges.begin(), scan->ranges.end(), [](float r) { return std::isnan(r); });
  if (blind) return {{DriveState::kNoLidar, "scan shows nothing, not even free space"}};
  if (isFresh(request.now, scan->stamp, options.lidar_timeout)) return std::nullopt;
  return {{DriveState::kNoLidar, ageText("scan", request.now, scan->stamp)}};
}

bool isStop(DriveState intent) {
  return intent == DriveState::kStopped || intent == DriveState::kDead || intent == DriveState::kNoLidar ||
         intent == DriveState::kNoOdometry;
}

Stop plannerFault(const ControlRequest& request, const ControlOptions& options) {
  if (isStop(request.intent)) return {{request.intent, request.intent_reason}};
  if (!isFresh(request.now, request.trajectory_stamp, options.trajectory_timeout)) {
    return {{DriveState::kStopped, "planner silent"}};
  }
  if (request.trajectory != nullptr && !request.trajectory->empty()) return std::nullopt;
  if (request.intent == DriveState::kDriving) return {{DriveState::kStopped, "no trajectory"}};
  return {{request.intent, request.intent_reason}};
}

}  // namespace

Stop reasonToStop(const ControlRequest& request, const ControlOptions& options) {
  if (!std::isfinite(request.now)) return {{DriveState::kStopped, "clock is not finite"}};
  if (Stop stop = odometryFault(request, options)) return stop;
  if (Stop stop = lidarFault(request, options)) return stop;
  return plannerFault(request, options);
}

}  // namespace parley

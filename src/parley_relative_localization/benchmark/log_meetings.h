// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "carmen_log.h"
#include "log_drive.h"

namespace parley::study {

/// Two scans of a log from which the one would have seen the other and been seen by it, had they been taken at one time.
struct Meeting {
  int first = 0, second = 0;  // [-] scans
};

/// All pairs of scans so many scans apart or more and `nearest` to `farthest` [m], each with the other's place in free view.
std::vector<Meeting> findMeetings(const CarmenLog& log, int apart, double nearest, double farthest);

/// A scan looked at the place and saw free space up to a body there.
bool hasInView(const LogScan& scan, const Eigen::Vector2d& place, double reach);

/// The stretch of `reach` scans either way of a scan.
Stretch stretchAbout(const CarmenLog& log, int scan, int reach, bool backwards);

/// Least distance between the places of two stretches. [m]
double distanceBetween(const CarmenLog& log, const Stretch& a, const Stretch& b);

}  // namespace parley::study

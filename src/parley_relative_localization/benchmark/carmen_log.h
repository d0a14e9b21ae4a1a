// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "parley_geometry/pose2.h"

namespace parley::study {

/// A scan of a log of the CARMEN toolkit: a half circle from right to left.
struct LogScan {
  Pose2 T_map_base;            // as corrected by the mapping that the log went through; the lidar is at base_link
  std::vector<float> ranges;   // [m]
  std::vector<Pose2> way;      // what the wheels said on the way to the next scan, as motions since this one
  double angle_min = 0.0;      // [rad]
  double angle_increment = 0;  // [rad]
};

struct CarmenLog {
  std::string name;
  std::vector<LogScan> scans;
  int malformed = 0;  // [-] lines that were left out
};

/// The FLASER and ODOM lines of a log's text. Broken lines are left out and counted. An ODOM line with stamp 0 sets the
/// odometry to the corrected pose and is no motion.
CarmenLog parseCarmenLog(const std::string& name, const std::string& text);

/// A log file, gzipped or not. Throws std::runtime_error if it cannot be read or holds no scan.
CarmenLog readCarmenLog(const std::string& path);

}  // namespace parley::study

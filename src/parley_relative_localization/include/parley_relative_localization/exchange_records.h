// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "parley_geometry/covariance.h"
#include "parley_geometry/footprint.h"
#include "parley_geometry/motion.h"

namespace parley {

// What robots tell each other for relative localization. Stamps are in the receiver's clock as the exchange converts them;
// the offset may be wrong by 0.2 s. Poses are in the odom frame of the robot they are about. The scan frame has its origin in
// the lidar and the axes of base_link.

/// A scan that stays as it is: descriptor and place.
struct Keyframe {
  int id = 0;          // [-] counts up on each robot
  double stamp = 0.0;  // [s]
  Pose2 T_odom_scan;
  std::vector<std::uint8_t> descriptor;  // by encodeScan
};

/// What could be a robot, as its lidar saw it.
struct SightedBlob {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // [m] middle of what is seen, scan frame
  double chord = 0.0;                                  // [m] width across the line of sight
};

/// All blobs of one scan, also none.
struct SightReport {
  double stamp = 0.0;  // [s]
  Pose2 T_odom_scan;
  std::vector<SightedBlob> blobs;
};

/// Where a robot was by its own odometry, from its beacon.
struct MotionReport {
  double stamp = 0.0;  // [s]
  Pose2 T_odom_base;
  Twist2 twist;
  Footprint footprint;
  double travel = 0.0;  // [m] its way since its start, RelativeLocalization::travel() there
};

/// A measured relative pose of two robots, each placed by its own odometry at that time.
struct RelativeEdge {
  std::string from, to;
  double stamp = 0.0;        // [s]
  Pose2 T_odom_from;         // in from's odom
  Pose2 T_odom_to;           // in to's odom
  double travel_from = 0.0;  // [m] from's way by its odometer
  double travel_to = 0.0;    // [m]
  PoseEstimate T_from_to;
};

}  // namespace parley

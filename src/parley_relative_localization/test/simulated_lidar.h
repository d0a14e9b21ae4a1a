// SPDX-License-Identifier: BSD-3-Clause
// A planar lidar among walls and robots, cast ray by ray; shares no code with what it tests.
#pragma once

#include <functional>
#include <random>
#include <vector>

#include "parley_geometry/footprint.h"
#include "parley_geometry/scan.h"

namespace parley::test {

constexpr Footprint kRobot{0.8, 0.4};

/// Range to the nearest wall along a unit direction, or anything above `limit` if there is none within it. [m]
using WallRange = std::function<double(const Eigen::Vector2d& from, const Eigen::Vector2d& direction, double limit)>;

struct WallSegment {
  Eigen::Vector2d a, b;
};

/// Walls as segments: exact.
WallRange segmentWorld(std::vector<WallSegment> walls);
std::vector<WallSegment> box(const Eigen::Vector2d& low, const Eigen::Vector2d& high);
std::vector<WallSegment> operator+(std::vector<WallSegment> a, const std::vector<WallSegment>& b);
/// A room of 9 x 6 m with niches and boxes that looks like no other place in it.
std::vector<WallSegment> distinctiveRoom();

/// Another robot, or a person, in the world.
struct Body {
  Footprint footprint;
  Pose2 T_world_body;
  bool moving = false;  // the lidar stage knows that it moves
};

struct LidarModel {
  double range = 4.0;   // [m]
  int beams = 720;      // [-]
  double noise = 0.02;  // [m]
};

/// Range along a unit direction to the nearest side of an outline, +inf past it. [m]
double bodyRange(const Eigen::Vector2d& from, const Eigen::Vector2d& direction, const Polygon& outline);

/// Fills in `blobs` from `ranges`. What is beside a bin that was not looked at stands off from nothing.
void findBlobs(ObstacleScan& scan);

/// What the lidar stage would make of a turn of the lidar: ranges, blobs, what is transient.
ObstacleScan simulatedScan(const WallRange& walls, const std::vector<Body>& bodies, const Pose2& T_world_base, double stamp,
                           const LidarModel& lidar, std::mt19937& random);

}  // namespace parley::test

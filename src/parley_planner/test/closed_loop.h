// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "parley_planner/planner.h"

namespace parley {

/// A flat world of solid and free cells of 0.05 m; all outside is solid.
struct World {
  GridFrame frame;
  std::vector<std::uint8_t> solid;

  World(double width, double height, bool filled);
  bool solidAt(const Eigen::Vector2d& p) const;
  void fill(double x1, double y1, double x2, double y2, bool value);
  /// Distance along a ray to the first solid cell, exact; +inf beyond `range_max`. [m]
  double castRay(const Eigen::Vector2d& from, double bearing, double range_max) const;
  /// Whether a rectangle overlaps a solid cell, exact.
  bool touches(const Footprint& footprint, const Pose2& pose) const;
  /// Distance of the rectangle to the nearest solid cell's square, up to 0.5 m.
  double clearance(const Footprint& footprint, const Pose2& pose) const;
};

/// Boxes strewn over a room, seeded.
World randomBoxes(unsigned seed, double size, int boxes);

struct RunSettings {
  Pose2 start;
  Eigen::Vector2d goal = Eigen::Vector2d::Zero();
  double duration = 60.0;  // [s]
  unsigned seed = 1;
  double noise = 0.02;  // [m] of the lidar
  PlannerOptions options;
};

struct RunResult {
  bool arrived = false;
  int collisions = 0;            // contiguous contacts
  double time = 0.0;             // [s] until standing at the goal
  double length = 0.0;           // [m]
  double least_clearance = 1e3;  // [m] true
  double standing = 0.0;         // [s]
  double final_distance = 0.0;   // [m]
  int refusals = 0;              // plans that ended in braking
  std::vector<TrajectoryPoint> track;
  std::vector<SampledTrajectory> committed;
  std::vector<std::string> log;
  std::vector<double> plan_ms;
  double meanSpeed() const { return time > 0.0 ? length / time : 0.0; }
};

constexpr Footprint robotFootprint() { return {0.8, 0.4}; }
constexpr MotionLimits robotLimits() { return {2.0, 1.5708, 2.0, 4.0}; }

/// Builds the local map out of scans as the topology stage would, in its simplest form.
class TrivialMap {
 public:
  explicit TrivialMap(const GridFrame& frame);
  void add(const ObstacleScan& scan, const Pose2& T_odom_scan);
  LocalMap window(const Eigen::Vector2d& middle, double stamp) const;
  Route route(const Eigen::Vector2d& from, const Eigen::Vector2d& goal) const;

 private:
  GridFrame frame_;
  std::vector<std::int8_t> evidence_;
  std::vector<std::uint8_t> seen_;
};

ObstacleScan castScan(const World& world, const Pose2& pose, double stamp, double noise, std::mt19937& random);

/// Drives one robot through a world: scan, map, route, plan, ideal tracking.
RunResult drive(const World& world, const RunSettings& settings);

}  // namespace parley

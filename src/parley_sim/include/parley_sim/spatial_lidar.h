// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "parley_geometry/scan.h"
#include "parley_sim/attitude.h"
#include "parley_sim/random_stream.h"
#include "parley_sim/scenario.h"
#include "parley_sim/scene.h"

namespace parley::sim {

/// A lidar that looks all around and from a little below the horizon to well above it, in a pattern that does not
/// repeat, while the robot moves under it. It sees the floor, walls 2.5 m high, robots and people, and no ceiling.
class SpatialLidar {
 public:
  SpatialLidar(const LidarSpec& spec, RandomStream noise);

  /// A robot's motion over one physics step, and its attitude.
  struct Motion {
    Pose2 from, to;         // T_world_base
    double start = 0.0;     // [s]
    double duration = 0.0;  // [s]
    Attitude::Angles attitude;
  };

  /// Adds the points of one physics step to the turn under way. `self`: the robot that carries it.
  void sweep(const Motion& motion, const Scene& scene, int self);

  /// Ends the turn: all points since the last one. `stamp`: of the first. [s]
  LidarCloud finish(double stamp);
  /// Time of the first point of the turn under way. [s]
  double turnStart() const { return turn_start_; }

 private:
  /// A ray in the world: along it the range is `1 / flat` times the distance over the floor.
  struct Ray {
    Eigen::Vector3d origin;
    Eigen::Vector3d direction;       // unit vector
    Eigen::Vector2d flat_direction;  // unit vector
    double flat;                     // [-] cosine of the elevation
  };

  Eigen::Vector3d nextDirection();
  double rangeOf(const Ray& ray, const Scene& scene, const std::vector<const Standing<Box>*>& boxes) const;
  std::vector<const Standing<Box>*> boxesNear(const Motion& motion, const Scene& scene, int self) const;

  LidarSpec spec_;
  RandomStream noise_;
  Eigen::Vector2d heading_ = Eigen::Vector2d::UnitX();  // unit vector of the azimuth
  double elevation_ = 0.0;                              // [-] of the span
  std::vector<Eigen::Vector2d> elevations_;             // cosine and sine over the span
  double owed_ = 0.0;                                   // [points] fraction of a point left over from the last step
  double turn_start_ = 0.0;
  bool turning_ = false;
  LidarCloud cloud_;
};

}  // namespace parley::sim

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "parley_geometry/scan.h"
#include "parley_sim/random_stream.h"
#include "parley_sim/scenario.h"
#include "parley_sim/scene.h"

namespace parley::sim {

/// A lidar that turns in one plane, all beams at the same instant. It sees whatever stands in the world, whatever its
/// height; no return is +inf and what is nearer than range_min is -inf (REP-117).
class PlanarLidar {
 public:
  PlanarLidar(const LidarSpec& spec, RandomStream noise);

  /// `self`: the robot that carries it, which it does not see.
  RangeScan scan(double stamp, const Pose2& T_world_base, const Scene& scene, int self);

 private:
  template <class Shape>
  void see(const Standing<Shape>& standing, const Pose2& T_world_lidar, std::vector<double>& ranges) const;
  Eigen::Vector2d directionOf(int beam, const Eigen::Vector2d& heading) const;

  LidarSpec spec_;
  RandomStream noise_;
  std::vector<Eigen::Vector2d> beams_;  // unit vectors in the lidar frame
};

}  // namespace parley::sim

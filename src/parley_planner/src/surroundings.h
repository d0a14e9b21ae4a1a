// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "distance_field.h"
#include "parley_geometry/footprint.h"
#include "parley_geometry/local_map.h"
#include "parley_geometry/scan.h"
#include "parley_geometry/tracked_object.h"

namespace parley {

/// What the robot must not touch and what it has not seen, as distance fields over the local map's window.
class Surroundings {
 public:
  Surroundings() = default;
  /// Occupied cells of the map and the newest scan's returns, but for those on `tracks` that move: these are judged
  /// where they will be, not where they are.
  Surroundings(const LocalMap& map, const ObstacleScan& scan, const Pose2& T_odom_scan, const std::vector<TrackedObject>& tracks);

  /// The same with more obstacles: those where `blocked(p)` holds.
  template <class Blocked>
  Surroundings with(const Blocked& blocked) const {
    std::vector<unsigned char> mask = mask_;
    for (int i = 0; i < static_cast<int>(mask.size()); ++i) {
      const Eigen::Vector2i cell(i % frame().width, i / frame().width);
      if (!mask[static_cast<std::size_t>(i)] && blocked(frame().centerOf(cell))) mask[static_cast<std::size_t>(i)] = 1;
    }
    Surroundings result = *this;
    result.obstacles_ = DistanceField(frame(), mask);
    return result;
  }
  bool empty() const { return obstacles_.empty(); }
  const GridFrame& frame() const { return obstacles_.frame(); }
  const DistanceField& obstacles() const { return obstacles_; }
  const DistanceField& unseen() const { return unseen_; }

 private:
  std::vector<unsigned char> mask_;  // of obstacles
  DistanceField obstacles_;
  DistanceField unseen_;
};

/// Distances from the footprint's rim, from lookups at points that cover it; exact to about 1 cm where it matters.
class FootprintProbe {
 public:
  explicit FootprintProbe(const Footprint& footprint);
  /// [m] from the rectangle at `pose` to what the field marks; negative inside.
  double clearance(const DistanceField& field, const Pose2& pose) const;
  double inscribedRadius() const { return inscribed_; }  // [m]

 private:
  struct Point {
    Eigen::Vector2d p_base;
    double radius;  // [m] of the disc that the point stands for
  };
  std::vector<Point> points_;
  double inscribed_;  // [m]
};

}  // namespace parley

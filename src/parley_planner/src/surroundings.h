// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "distance_field.h"
#include "parley_geometry/footprint.h"
#include "parley_geometry/local_map.h"
#include "parley_geometry/scan.h"
#include "parley_geometry/tracked_object.h"

namespace parley {

/// Places that are no obstacles, but that the robot means to leave free.
struct Blocked {
  struct Disc {
    Eigen::Vector2d center;  // [m]
    double radius;           // [m] open: its rim is free
  };
  struct Body {
    Pose2 pose;
    Footprint footprint;
    double growth;  // [m] on each side
  };
  std::vector<Disc> discs;
  std::vector<Body> bodies;

  /// All that is nearer than `half_width` [m] to one of the points of `middle`.
  void addStrip(const std::vector<Eigen::Vector2d>& middle, double half_width);
};

/// What the robot must not touch and what it has not seen, as distance fields over the local map's window.
class Surroundings {
 public:
  Surroundings() = default;
  /// Occupied cells of the map and the newest scan's returns, but for those on `tracks` that move: these are judged
  /// where they will be, not where they are.
  Surroundings(const LocalMap& map, const ObstacleScan& scan, const Pose2& T_odom_scan, const std::vector<TrackedObject>& tracks);

  /// The same with more obstacles.
  Surroundings with(const Blocked& blocked) const;
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
  double inscribedRadius() const { return footprint_.inscribedRadius(); }  // [m]
  const Footprint& footprint() const { return footprint_; }

 private:
  struct Point {
    Eigen::Vector2d p_base;
    double radius;  // [m] of the disc that the point stands for
  };
  std::vector<Point> points_;
  Footprint footprint_;
};

}  // namespace parley

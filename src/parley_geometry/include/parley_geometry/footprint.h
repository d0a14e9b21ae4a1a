// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "parley_geometry/options.h"
#include "parley_geometry/polygon.h"

namespace parley {

/// Rectangle that a robot covers, base_link in its centre. Has no default: whoever starts a robot says it.
struct Footprint {
  double length = 0.0;  // [m] along x of base_link
  double width = 0.0;   // [m] along y of base_link

  double inscribedRadius() const;
  double circumscribedRadius() const;
  /// Corners in base_link, counter-clockwise, grown by `margin` [m] on every side.
  Polygon polygon(double margin = 0.0) const;
  /// Corners in the frame in which `pose` is given.
  Polygon polygonAt(const Pose2& pose, double margin = 0.0) const;
  bool contains(const Eigen::Vector2d& p_base, double margin = 0.0) const;

  template <class Visitor>
  void visit(Visitor& v) {
    v.number("length", length, "m", 0.05, 5.0, "length of the robot, along its x axis");
    v.number("width", width, "m", 0.05, 5.0, "width of the robot, along its y axis");
  }
};

/// Discs of equal radius along the longer axis that together cover the footprint; fewer discs overhang more.
struct DiscCover {
  std::vector<double> offsets;  // [m] along x of base_link
  double radius = 0.0;          // [m]
  bool along_x = true;          // false if the robot is wider than long: offsets are along y
};

DiscCover coverWithDiscs(const Footprint& footprint, int count);

}  // namespace parley

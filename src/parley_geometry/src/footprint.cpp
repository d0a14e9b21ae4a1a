// SPDX-License-Identifier: BSD-3-Clause
#include "parley_geometry/footprint.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace parley {

double Footprint::inscribedRadius() const { return 0.5 * std::min(length, width); }

double Footprint::circumscribedRadius() const { return 0.5 * std::hypot(length, width); }

Polygon Footprint::polygon(double margin) const {
  const double x = 0.5 * length + margin, y = 0.5 * width + margin;
  return {{x, y}, {-x, y}, {-x, -y}, {x, -y}};
}

Polygon Footprint::polygonAt(const Pose2& pose, double margin) const { return transformed(pose, polygon(margin)); }

bool Footprint::contains(const Eigen::Vector2d& p_base, double margin) const {
  return std::abs(p_base.x()) <= 0.5 * length + margin && std::abs(p_base.y()) <= 0.5 * width + margin;
}

DiscCover coverWithDiscs(const Footprint& footprint, int count) {
  assert(count >= 1);
  DiscCover cover;
  cover.along_x = footprint.length >= footprint.width;
  const double longer = std::max(footprint.length, footprint.width);
  const double shorter = std::min(footprint.length, footprint.width);
  const double slice = longer / count;
  cover.radius = 0.5 * std::hypot(slice, shorter);
  for (int i = 0; i < count; ++i) cover.offsets.push_back(-0.5 * longer + (i + 0.5) * slice);
  return cover;
}

}  // namespace parley

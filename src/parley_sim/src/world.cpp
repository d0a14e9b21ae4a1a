// SPDX-License-Identifier: BSD-3-Clause
#include "parley_sim/world.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "distance_field.h"

namespace parley::sim {
namespace {

constexpr double kDiagonal = 1.4142136;  // [cells] two points, each in its square, against the centres of the squares

}  // namespace

World::World(const GridFrame& frame, const std::vector<std::uint8_t>& solid)
    : frame_(frame), gaps_(cellGaps(frame.width, frame.height, solid)) {}

double World::freeRadius(const Eigen::Vector2d& point) const {
  return std::max(0.0, (cellGap(frame_.cellOf(point)) - kDiagonal) * frame_.resolution);
}

Box World::squareOf(int x, int y) const {
  return {frame_.centerOf({x, y}), Eigen::Vector2d::UnitX(), 0.5 * frame_.resolution, 0.5 * frame_.resolution};
}

double World::distanceToSolid(const Eigen::Vector2d& point, double limit) const {
  if (freeRadius(point) >= limit) return limit;
  const Eigen::Vector2i low = frame_.cellOf(point.array() - limit).cwiseMax(-1);
  const Eigen::Vector2i high = frame_.cellOf(point.array() + limit).cwiseMin(Eigen::Vector2i(frame_.width, frame_.height));
  const double half = 0.5 * frame_.resolution;
  double nearest = limit * limit;
  for (int y = low.y(); y <= high.y(); ++y) {
    const double dy = std::max(0.0, std::abs(point.y() - frame_.centerOf({low.x(), y}).y()) - half);
    if (dy * dy >= nearest) continue;
    for (int x = low.x(); x <= high.x(); ++x) {
      if (gaps_[gapIndex(x, y)] != 0.0F) continue;
      const double dx = std::max(0.0, std::abs(point.x() - frame_.centerOf({x, y}).x()) - half);
      nearest = std::min(nearest, dx * dx + dy * dy);
    }
  }
  return std::sqrt(nearest);
}

double World::distanceToSolid(const Box& box, double limit) const {
  const double reach = limit + box.circumradius();
  if (freeRadius(box.center) >= reach) return limit;
  const Eigen::Vector2i low = frame_.cellOf(box.center.array() - reach).cwiseMax(-1);
  const Eigen::Vector2i high = frame_.cellOf(box.center.array() + reach).cwiseMin(Eigen::Vector2i(frame_.width, frame_.height));
  double nearest = limit;
  for (int y = low.y(); y <= high.y(); ++y) {
    for (int x = low.x(); x <= high.x(); ++x) {
      if (gaps_[gapIndex(x, y)] != 0.0F) continue;
      const Box square = squareOf(x, y);
      if (distance(box, square.center) - square.circumradius() >= nearest) continue;
      nearest = std::min(nearest, distance(box, square));
    }
  }
  return nearest;
}

bool World::overlapsSolid(const Box& box) const {
  if (freeRadius(box.center) >= box.circumradius()) return false;
  const double reach = box.circumradius();
  const Eigen::Vector2i low = frame_.cellOf(box.center.array() - reach);
  const Eigen::Vector2i high = frame_.cellOf(box.center.array() + reach);
  for (int y = low.y(); y <= high.y(); ++y) {
    for (int x = low.x(); x <= high.x(); ++x) {
      if (isSolid(Eigen::Vector2i(x, y)) && overlap(squareOf(x, y), box)) return true;
    }
  }
  return false;
}

double World::castRay(const Eigen::Vector2d& origin, const Eigen::Vector2d& direction, double max_range) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double px = (origin.x() - frame_.origin.x()) / frame_.resolution;
  const double py = (origin.y() - frame_.origin.y()) / frame_.resolution;
  const double limit = max_range / frame_.resolution;
  const int step_x = direction.x() < 0.0 ? -1 : 1, step_y = direction.y() < 0.0 ? -1 : 1;
  const double inverse_x = 1.0 / direction.x(), inverse_y = 1.0 / direction.y();
  int x = static_cast<int>(std::floor(px)), y = static_cast<int>(std::floor(py));
  if (!frame_.contains({x, y})) return 0.0;
  double t = 0.0;
  while (t <= limit) {
    const double gap = gaps_[gapIndex(x, y)];
    if (gap == 0.0) return t * frame_.resolution;
    if (gap > 3.0) {  // far from all walls: leap to where the nearest of them could be
      t += gap - kDiagonal;
      x = static_cast<int>(std::floor(px + t * direction.x()));
      y = static_cast<int>(std::floor(py + t * direction.y()));
      continue;
    }
    // near a wall: from square to square, exactly
    const double to_x = (x + (step_x > 0 ? 1 : 0) - px) * inverse_x;
    const double to_y = (y + (step_y > 0 ? 1 : 0) - py) * inverse_y;
    if (direction.y() == 0.0 || (direction.x() != 0.0 && to_x < to_y)) {
      t = to_x;
      x += step_x;
    } else {
      t = to_y;
      y += step_y;
    }
  }
  return kInfinity;
}

bool World::inSight(const Eigen::Vector2d& a, const Eigen::Vector2d& b) const {
  const double gap = (b - a).norm();
  return gap == 0.0 || castRay(a, (b - a) / gap, gap) > gap;
}

}  // namespace parley::sim

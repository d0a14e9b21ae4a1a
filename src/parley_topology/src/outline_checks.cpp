// SPDX-License-Identifier: BSD-3-Clause
#include "outline_checks.h"

namespace parley {
namespace {

constexpr double kStep = 0.05;          // [m] between the points of an outline that are looked at
constexpr double kElsewhere = 0.3;      // [m] what is occupied nearer than this may be what the outline means
constexpr double kLeastStretch = 0.25;  // [m] of an outline that is seen through before that counts
constexpr int kLater = 2;               // [s] by which the look must be newer
constexpr double kAlong = 0.15;         // [m] to each side of an outline that is forgotten

/// Calls visit(point) along an outline.
template <class Visit>
void walkAlong(const Polygon& polygon, bool closed, const Visit& visit) {
  const std::size_t segments = polygon.size() < 2 || closed ? polygon.size() : polygon.size() - 1;
  for (std::size_t i = 0; i < segments; ++i) {
    const Eigen::Vector2d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const int steps = std::max(1, static_cast<int>(std::ceil((b - a).norm() / kStep)));
    for (int k = 0; k < steps; ++k) visit(a + (b - a) * (static_cast<double>(k) / steps));
  }
}

}  // namespace

bool isSeenThrough(TiledMap& map, const FieldShape& shape, const Pose2& T_odom_peer, const LayerContour& contour) {
  const int told = map.secondsOf(contour.stamp);
  if (told == 0) return false;
  double stretch = 0.0, longest = 0.0;
  walkAlong(transformed(T_odom_peer, contour.polygon), contour.closed, [&](const Eigen::Vector2d& p) {
    const int x = map.cellOf(p.x()), y = map.cellOf(p.y());
    const Tile* tile = map.isOutside(p) ? nullptr : map.find(tileOf(x), tileOf(y));
    const std::size_t i = offsetOf(x, y);
    const bool through = tile && (tile->flags[i] & kSeen) && tile->looked[i] >= told + kLater &&
                         metersOf(tile->distance[i], shape.reach) > kElsewhere;
    stretch = through ? stretch + kStep : 0.0;
    longest = std::max(longest, stretch);
  });
  return longest >= kLeastStretch;
}

void forgetAlong(TiledMap& map, const Refuted& outline) {
  const int before = map.secondsOf(outline.before);
  const int reach = static_cast<int>(std::lround(kAlong / map.resolution()));
  walkAlong(outline.polygon, outline.closed, [&](const Eigen::Vector2d& p) {
    if (map.isOutside(p)) return;
    const int cx = map.cellOf(p.x()), cy = map.cellOf(p.y());
    forEachTile({cx - reach, cy - reach, cx + reach + 1, cy + reach + 1}, [&](int tx, int ty, const CellRect& part) {
      Tile* tile = map.find(tx, ty);
      for (int y = part.y0; tile && y < part.y1; ++y) {
        for (int x = part.x0; x < part.x1; ++x) {
          const std::size_t i = offsetOf(x, y);
          if ((tile->flags[i] & kOwn) && tile->looked[i] < before) map.forgetCell(*tile, x, y);
        }
      }
    });
  });
}

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#include "homotopy.h"

#include "parley_geometry/polygon.h"

namespace parley {
namespace {

/// The part of the loop in which the ways differ.
std::vector<Eigen::Vector2d> differenceLoop(const std::vector<Eigen::Vector2d>& a, const std::vector<Eigen::Vector2d>& b) {
  std::size_t same = 0;  // points in common at the start
  const std::size_t shorter = std::min(a.size(), b.size());
  while (same < shorter && a[same] == b[same]) ++same;
  std::size_t tail = 0;  // and at the end
  while (tail + same < shorter && a[a.size() - 1 - tail] == b[b.size() - 1 - tail]) ++tail;
  const std::size_t first = same > 0 ? same - 1 : 0;
  const auto last = [tail](const std::vector<Eigen::Vector2d>& way) { return way.size() - (tail > 0 ? tail - 1 : 0); };
  std::vector<Eigen::Vector2d> loop(a.begin() + static_cast<std::ptrdiff_t>(first),
                                    a.begin() + static_cast<std::ptrdiff_t>(last(a)));
  for (std::size_t i = last(b); i > first; --i) loop.push_back(b[i - 1]);
  return loop;
}

}  // namespace

int windingNumber(const std::vector<Eigen::Vector2d>& loop, const Eigen::Vector2d& point) {
  int winding = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Eigen::Vector2d a = loop[i] - point, b = loop[(i + 1) % loop.size()] - point;
    if ((a.y() <= 0.0) == (b.y() <= 0.0)) continue;
    const double side = cross(a, b);
    if (a.y() <= 0.0 && side > 0.0) ++winding;
    if (a.y() > 0.0 && side < 0.0) --winding;
  }
  return winding;
}

std::vector<Eigen::Vector2d> obstaclePoints(const TiledMap& map) {
  std::vector<Eigen::Vector2d> points;
  for (const auto& tile : map.tiles()) {
    for (const Chain& chain : tile->chains) points.push_back(chain.core);
  }
  return points;
}

std::vector<Eigen::Vector2d> pointsBetween(const std::vector<Eigen::Vector2d>& obstacles, const std::vector<Eigen::Vector2d>& a,
                                           const std::vector<Eigen::Vector2d>& b) {
  std::vector<Eigen::Vector2d> between;
  const std::vector<Eigen::Vector2d> loop = differenceLoop(a, b);
  if (loop.size() < 3) return between;
  Eigen::Vector2d low = loop.front(), high = loop.front();
  for (const Eigen::Vector2d& p : loop) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  for (const Eigen::Vector2d& p : obstacles) {
    const bool near = (p.array() >= low.array()).all() && (p.array() <= high.array()).all();
    if (near && windingNumber(loop, p) != 0) between.push_back(p);
  }
  return between;
}

bool sameClass(const std::vector<Eigen::Vector2d>& obstacles, const std::vector<Eigen::Vector2d>& a,
               const std::vector<Eigen::Vector2d>& b) {
  return pointsBetween(obstacles, a, b).empty();
}

}  // namespace parley

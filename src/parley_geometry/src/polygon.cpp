// SPDX-License-Identifier: BSD-3-Clause
#include "parley_geometry/polygon.h"

#include <algorithm>
#include <limits>

namespace parley {
namespace {

const Eigen::Vector2d& next(const Polygon& polygon, std::size_t i) { return polygon[(i + 1) % polygon.size()]; }

bool onSegment(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return std::min(a.x(), b.x()) <= p.x() && p.x() <= std::max(a.x(), b.x()) && std::min(a.y(), b.y()) <= p.y() &&
         p.y() <= std::max(a.y(), b.y());
}

/// Whether some edge of `a` has all of `b` on its outer side.
bool hasSeparatingEdge(const Polygon& a, const Polygon& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Eigen::Vector2d edge = next(a, i) - a[i];
    const bool separates = std::all_of(b.begin(), b.end(), [&](const Eigen::Vector2d& p) { return cross(edge, p - a[i]) < 0.0; });
    if (separates) return true;
  }
  return false;
}

}  // namespace

double signedArea(const Polygon& polygon) {
  double twice = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) twice += cross(polygon[i], next(polygon, i));
  return 0.5 * twice;
}

double perimeter(const Polygon& polygon) {
  double sum = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) sum += (next(polygon, i) - polygon[i]).norm();
  return sum;
}

bool contains(const Polygon& polygon, const Eigen::Vector2d& p) {
  bool inside = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d &a = polygon[i], &b = next(polygon, i);
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    if (p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
  }
  return inside;
}

bool isSimple(const Polygon& polygon) {
  const std::size_t n = polygon.size();
  if (n < 3) return false;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 2; j < n; ++j) {
      if (i == 0 && j == n - 1) continue;
      if (segmentsIntersect(polygon[i], next(polygon, i), polygon[j], next(polygon, j))) return false;
    }
  }
  return true;
}

bool isConvex(const Polygon& polygon) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d &a = polygon[i], &b = next(polygon, i), &c = next(polygon, (i + 1) % polygon.size());
    if (cross(b - a, c - b) < 0.0) return false;
  }
  return polygon.size() >= 3;
}

double pointSegmentDistance(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const Eigen::Vector2d ab = b - a;
  const double length2 = ab.squaredNorm();
  const double t = length2 > 0.0 ? std::clamp((p - a).dot(ab) / length2, 0.0, 1.0) : 0.0;
  return (p - a - t * ab).norm();
}

std::optional<Eigen::Vector2d> segmentIntersection(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
                                                   const Eigen::Vector2d& d) {
  const Eigen::Vector2d ab = b - a, cd = d - c;
  const double denominator = cross(ab, cd);
  if (denominator == 0.0) return std::nullopt;
  const double t = cross(c - a, cd) / denominator;
  const double u = cross(c - a, ab) / denominator;
  if (t < 0.0 || t > 1.0 || u < 0.0 || u > 1.0) return std::nullopt;
  return a + t * ab;
}

bool segmentsIntersect(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c, const Eigen::Vector2d& d) {
  const double d1 = cross(b - a, c - a), d2 = cross(b - a, d - a);
  const double d3 = cross(d - c, a - c), d4 = cross(d - c, b - c);
  if (((d1 > 0) != (d2 > 0)) && ((d3 > 0) != (d4 > 0)) && d1 != 0 && d2 != 0 && d3 != 0 && d4 != 0) return true;
  return (d1 == 0 && onSegment(c, a, b)) || (d2 == 0 && onSegment(d, a, b)) || (d3 == 0 && onSegment(a, c, d)) ||
         (d4 == 0 && onSegment(b, c, d));
}

double segmentDistance(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c, const Eigen::Vector2d& d) {
  if (segmentsIntersect(a, b, c, d)) return 0.0;
  return std::min({pointSegmentDistance(a, c, d), pointSegmentDistance(b, c, d), pointSegmentDistance(c, a, b),
                   pointSegmentDistance(d, a, b)});
}

double convexDistance(const Polygon& a, const Polygon& b) {
  if (convexOverlap(a, b)) return 0.0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      least = std::min(least, segmentDistance(a[i], next(a, i), b[j], next(b, j)));
    }
  }
  return least;
}

bool convexOverlap(const Polygon& a, const Polygon& b) { return !hasSeparatingEdge(a, b) && !hasSeparatingEdge(b, a); }

Polygon transformed(const Pose2& T_parent_child, const Polygon& polygon_child) {
  Polygon result;
  result.reserve(polygon_child.size());
  const double c = std::cos(T_parent_child.yaw), s = std::sin(T_parent_child.yaw);
  for (const Eigen::Vector2d& p : polygon_child) {
    result.emplace_back(T_parent_child.x + c * p.x() - s * p.y(), T_parent_child.y + s * p.x() + c * p.y());
  }
  return result;
}

double pathLength(const std::vector<Eigen::Vector2d>& path) {
  double sum = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) sum += (path[i] - path[i - 1]).norm();
  return sum;
}

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "parley_geometry/pose2.h"

namespace parley {

/// Closed chain of corners, the last joined to the first. Counter-clockwise encloses positive area.
using Polygon = std::vector<Eigen::Vector2d>;

/// z of the cross product a x b.
inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Signed area, positive if counter-clockwise. [m^2]
double signedArea(const Polygon& polygon);

double perimeter(const Polygon& polygon);

/// Even-odd rule; points on the boundary may count either way.
bool contains(const Polygon& polygon, const Eigen::Vector2d& point);

/// No two edges that are not neighbours touch. O(n^2): for contours of tens of corners.
bool isSimple(const Polygon& polygon);

/// Every corner turns left (counter-clockwise) or goes straight.
bool isConvex(const Polygon& polygon);

double pointSegmentDistance(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b);

/// Where two segments meet; nullopt if they do not, or are parallel.
std::optional<Eigen::Vector2d> segmentIntersection(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
                                                   const Eigen::Vector2d& d);

bool segmentsIntersect(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c, const Eigen::Vector2d& d);

/// Distance between two segments, 0 if they cross. [m]
double segmentDistance(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c, const Eigen::Vector2d& d);

/// Distance between the areas of two convex polygons, 0 if they overlap. [m]
double convexDistance(const Polygon& a, const Polygon& b);

/// Whether two convex, counter-clockwise polygons overlap (separating axes); touching counts.
bool convexOverlap(const Polygon& a, const Polygon& b);

Polygon transformed(const Pose2& T_parent_child, const Polygon& polygon_child);

/// Length of an open chain of points. [m]
double pathLength(const std::vector<Eigen::Vector2d>& path);

}  // namespace parley

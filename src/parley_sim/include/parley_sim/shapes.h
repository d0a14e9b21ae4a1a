// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "parley_geometry/pose2.h"

namespace parley::sim {

/// A rectangle in the world frame. The simulator's own geometry: it judges the robots, so it shares no code with theirs.
struct Box {
  Eigen::Vector2d center = Eigen::Vector2d::Zero();  // [m]
  Eigen::Vector2d axis = Eigen::Vector2d::UnitX();   // [-] unit vector along the length
  double half_length = 0.0;                          // [m]
  double half_width = 0.0;                           // [m]

  double circumradius() const;
  Eigen::Vector2d toLocal(const Eigen::Vector2d& point) const;
  std::array<Eigen::Vector2d, 4> corners() const;
};

struct Disc {
  Eigen::Vector2d center = Eigen::Vector2d::Zero();  // [m]
  double radius = 0.0;                               // [m]
};

/// A box of the given size, centred at a pose.
Box boxAt(const Pose2& pose, double length, double width);

/// The box that a segment of the given thickness covers, ends cut square.
Box boxOfSegment(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double thickness);

/// Whether the areas share more than a boundary.
bool overlap(const Box& a, const Box& b);
bool overlap(const Box& box, const Disc& disc);

/// Gap between the areas, 0 if they overlap. [m]
double distance(const Box& box, const Eigen::Vector2d& point);
double distance(const Box& a, const Box& b);
double distance(const Box& box, const Disc& disc);

/// Where a line from `origin` along the unit vector `direction` is inside a shape. [m] from the origin, enter <= leave.
struct Crossing {
  double enter = 0.0;
  double leave = 0.0;
};
std::optional<Crossing> crossing(const Box& box, const Eigen::Vector2d& origin, const Eigen::Vector2d& direction);
std::optional<Crossing> crossing(const Disc& disc, const Eigen::Vector2d& origin, const Eigen::Vector2d& direction);

}  // namespace parley::sim

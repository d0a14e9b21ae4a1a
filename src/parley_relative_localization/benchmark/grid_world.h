// SPDX-License-Identifier: BSD-3-Clause
// Worlds of the encounter study: map_server files and drawn ones, rays through their cells, and ways through their free space.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace parley::study {

/// An occupancy grid; what is outside is solid.
class GridWorld {
 public:
  GridWorld(std::string name, double resolution, int columns, int rows, std::vector<bool> solid);

  /// A map_server yaml file. Throws std::runtime_error if it cannot be read.
  static GridWorld load(const std::string& path);
  /// Pillars and niches that repeat every 4 m, exactly.
  static GridWorld periodic();
  /// Rooms along a corridor; the right half is the mirror image of the left.
  static GridWorld mirrored();

  const std::string& name() const { return name_; }
  double range(const Eigen::Vector2d& from, const Eigen::Vector2d& direction, double limit) const;
  /// Distance to the nearest solid cell, at most 2 m. [m]
  double clearance(const Eigen::Vector2d& p) const;
  /// A place with that much room around it.
  Eigen::Vector2d place(double clearance, std::mt19937& random) const;
  double resolution() const { return resolution_; }
  int columns() const { return columns_; }
  int rows() const { return rows_; }

 private:
  bool isSolid(long column, long row) const;
  void measureClearance();

  std::string name_;
  double resolution_;  // [m]
  int columns_, rows_;
  std::vector<bool> solid_;
  std::vector<float> clearance_;  // [m]
};

/// Distances to a goal through free space, on a coarse grid.
class GoalField {
 public:
  GoalField(const GridWorld& world, const Eigen::Vector2d& goal, double clearance);

  /// Length of the way, infinite where there is none. [m]
  double distance(const Eigen::Vector2d& p) const;
  /// A place on the way to the goal, about `ahead` [m] from p.
  Eigen::Vector2d target(const Eigen::Vector2d& p, double ahead) const;

 private:
  static constexpr double kCell = 0.2;  // [m]
  long cellOf(const Eigen::Vector2d& p) const;
  Eigen::Vector2d centerOf(long cell) const;

  long columns_, rows_;
  std::vector<float> distances_;  // [m]
};

}  // namespace parley::study

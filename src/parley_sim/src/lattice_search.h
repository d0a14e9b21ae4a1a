// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "parley_sim/world.h"

namespace parley::sim {

/// A* for a disc over a lattice of points with edges in 32 directions, so that no way is more than 1.3 % too long. The
/// lattice lies on the corners of the world's cells, at about 5 cm whatever their size, so that axis-aligned passages
/// keep their width.
class LatticeSearch {
 public:
  LatticeSearch(const World& world, double radius);

  double spacing() const { return spacing_; }
  bool isFree(const Eigen::Vector2d& point) const;
  std::optional<std::vector<Eigen::Vector2d>> path(const Eigen::Vector2d& start, const Eigen::Vector2d& goal);

 private:
  struct Open {
    double estimate;
    double cost;
    int node;
  };
  struct Later {
    bool operator()(const Open& a, const Open& b) const {
      return a.estimate != b.estimate ? a.estimate > b.estimate : a.node > b.node;
    }
  };

  Eigen::Vector2d pointOf(int node) const;
  bool isFree(int x, int y);
  std::vector<int> nodesNear(const Eigen::Vector2d& point);
  void reach(int node, int parent, double cost, const Eigen::Vector2d& goal);
  void expand(const Open& from, const Eigen::Vector2d& goal);
  std::vector<Eigen::Vector2d> trace(int last, const Eigen::Vector2d& start, const Eigen::Vector2d& goal) const;

  const World& world_;
  double radius_;
  double spacing_;
  int width_, height_;
  std::vector<std::int8_t> free_;  // -1 not looked at yet
  std::vector<double> costs_;
  std::vector<int> parents_;
  std::vector<Open> open_;  // a heap
};

}  // namespace parley::sim

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>

#include "clearance_field.h"
#include "parley_topology/topology_options.h"
#include "parley_topology/visibility_graph.h"
#include "tiled_map.h"

namespace parley {

/// How far a straight way gets.
struct Walk {
  bool open = false;
  Eigen::Vector2i blocked_at = Eigen::Vector2i::Zero();  // a cell that is not passable, if not open
};

/// Tests and measures straight ways on the map. The answer for (a, b) is that for (b, a), to the last bit.
class Sight {
 public:
  Sight(const TiledMap& map, const TopologyOptions& options, const FieldShape& shape)
      : map_(map), options_(options), shape_(shape) {}

  /// Whether all cells along the way are passable; looked at are those of its part between two fractions.
  Walk walk(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double from = 0.0, double to = 1.0) const;

  /// A cell that is in the way, looked for where the way comes nearest to `cell` alone. What this finds, `walk` would too.
  std::optional<Eigen::Vector2i> shutNear(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2i& cell) const;

  /// Length, cost and what they are made of, for a way that is open.
  Edge measure(const Eigen::Vector2d& a, const Eigen::Vector2d& b) const;

  /// Walk and measure; nullopt if the way is not open.
  std::optional<Edge> look(const Eigen::Vector2d& a, const Eigen::Vector2d& b) const;

  /// The point itself if its cell has the flag (kWide or kPassable), else the nearest middle of a cell that has it, within
  /// `tolerance` [m] and not behind something occupied; nullopt if there is none.
  std::optional<Eigen::Vector2d> nearestWith(CellFlag flag, const Eigen::Vector2d& p, double tolerance) const;

 private:
  struct Samples;
  std::uint8_t flagsAt(const Eigen::Vector2d& p) const { return map_.flags(map_.cellOf(p.x()), map_.cellOf(p.y())); }
  double distanceAt(const Eigen::Vector2d& p) const {
    return metersOf(map_.distance(map_.cellOf(p.x()), map_.cellOf(p.y())), shape_.reach);
  }
  double roomTowards(const Eigen::Vector2d& from, const Eigen::Vector2d& direction, double enough) const;
  void measureSeen(Edge& edge, const Eigen::Vector2d& a, const Eigen::Vector2d& b) const;
  void measureWidth(Edge& edge, const Eigen::Vector2d& a, const Eigen::Vector2d& b) const;
  bool reaches(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const;

  const TiledMap& map_;
  const TopologyOptions& options_;
  const FieldShape& shape_;
};

/// Measures an edge of a graph unless that is done; an empty slot is left alone.
void measureEdge(VisibilityGraph& graph, int slot, const Sight& sight);

/// Cost of an edge from its measures. [m]
double costOf(const Edge& edge, const TopologyOptions& options);

}  // namespace parley

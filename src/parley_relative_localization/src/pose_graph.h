// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "parley_relative_localization/exchange_records.h"
#include "parley_relative_localization/relative_localization_options.h"

namespace parley {

/// Where a robot is by its own odometry: a node of the graph.
struct Anchor {
  Pose2 T_odom_base;
  double travel = 0.0;  // [m] by its odometer
};

/// Another robot's odom frame in this robot's, by all edges together.
struct GraphEstimate {
  PoseEstimate T_odom_peerodom;
  double stamp = 0.0;   // [s] of the newest edge to it
  double travel = 0.0;  // [m] of its odometer at its newest anchor
  int edges = 0;        // [-] that hold between the robots on the way
};

/// Measured poses between any two robots, and what follows from them for this one: odometry edges with drift, measured edges
/// with a Cauchy loss, of each pair only the largest set that agrees through both odometries.
class PoseGraph {
 public:
  PoseGraph(const RelativeLocalizationOptions& options, std::string own_name);

  /// An edge of the same two robots measured nearby on their ways is replaced. At the bound the oldest goes.
  void add(const RelativeEdge& edge);
  void forget(const std::string& robot);
  bool changed() const { return changed_; }
  const std::vector<RelativeEdge>& edges() const { return edges_; }

  /// All robots that edges lead to, from where this robot is now.
  std::map<std::string, GraphEstimate> solve(const Anchor& own);

 private:
  std::vector<RelativeEdge> consistentEdges() const;
  bool agree(const RelativeEdge& a, const RelativeEdge& b) const;

  RelativeLocalizationOptions options_;
  std::string own_name_;
  std::vector<RelativeEdge> edges_;  // oldest first
  bool changed_ = false;
};

/// Covariance of odometry over a way, as of T_from_to. The heading's error acts over half the way on average.
Covariance3 driftOver(double way, const RelativeLocalizationOptions& options);

/// The same edge seen from the other robot.
RelativeEdge reversed(const RelativeEdge& edge);

}  // namespace parley

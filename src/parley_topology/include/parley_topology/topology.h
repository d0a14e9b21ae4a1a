// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "parley_geometry/footprint.h"
#include "parley_geometry/local_map.h"
#include "parley_geometry/route.h"
#include "parley_geometry/scan.h"
#include "parley_topology/contour.h"
#include "parley_topology/topology_options.h"
#include "parley_topology/visibility_graph.h"

namespace parley {

/// What an update did and what is held after it.
struct TopologyResult {
  bool changed = false;    // the graph is not what it was
  int vertices = 0;        // [-]
  int edges = 0;           // [-]
  int added = 0;           // [-] vertices that were not there before
  int removed = 0;         // [-] vertices that are gone
  int tiles = 0;           // [-]
  int layers = 0;          // [-]
  int refused = 0;         // [-] scans, poses and layers that were not usable, since the start
  bool saturated = false;  // a bound was met: something is not in the map or the graph
};

/// The strategic layer of a robot (the paper's Algorithm 1): fuses obstacle scans and peers' outlines into one map, keeps
/// the visibility graph of its corners, and finds the way to a goal on it.
class Topology {
 public:
  /// Throws std::invalid_argument for options out of range or a footprint without size.
  Topology(const TopologyOptions& options, const Footprint& footprint);
  ~Topology();
  Topology(Topology&&) noexcept;
  Topology& operator=(Topology&&) noexcept;

  /// Takes a scan into the map; for each scan. A pose or a scan that is not usable is refused and counted.
  void integrate(const ObstacleScan& scan, const Pose2& T_odom_base);

  /// Lays an origin's outlines over the map in place of what was held of that origin. Own sensing wins where it has seen,
  /// unless an outline is newer and nothing is where own sensing looked: a door that has been shut since.
  void setLayer(const LayerUpdate& layer);
  /// Leaves map and graph as if the layer had never been there.
  void removeLayer(const std::string& origin);

  /// Outlines of layers that block and that own sensing has looked through since they were told: to be contested.
  std::vector<SeenThrough> seenThrough() const;
  /// Forgets what own sensing held occupied along an outline that somebody has seen through since.
  void forget(const Refuted& outline);

  /// A passage on the route at `p_odom` [m] that turned out too narrow to drive: routes avoid it until what stands beside it has
  /// gone or nothing else leads to the goal. False if nothing stands there.
  bool shutPassage(const Eigen::Vector2d& p_odom);

  /// Brings contours and graph up to date with all that changed since the last call.
  TopologyResult update();

  /// The way to a goal on the graph as of the last update. Keeps to the side of obstacles it has committed to unless the
  /// way is shut or another is much cheaper. While nothing leads there it takes back what may have changed unseen, from the
  /// next update on: what came where nothing was and is out of view, then peers' outlines too.
  Route route(const Pose2& T_odom_base, const Eigen::Vector2d& goal_odom);

  /// A square window of `size` [m] around `center`, aligned with the map's cells, as of `stamp` [s]. What came where nothing
  /// was and has not been looked at for a while is unknown: nobody should count on it as a wall.
  LocalMap localMap(const Eigen::Vector2d& center, double size, double stamp) const;

  const VisibilityGraph& graph() const;
  /// Outlines of what own sensing holds occupied, in a fixed order: what peers may be told.
  std::vector<Contour> contours() const;
  /// The same for the fused map.
  std::vector<Contour> fusedContours() const;

  /// Forgets everything.
  void reset();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#include "parley_topology/topology.h"

#include <stdexcept>

#include "doubts.h"
#include "evidence.h"
#include "graph_builder.h"
#include "map_outlines.h"
#include "outline_checks.h"
#include "route_keeper.h"
#include "shut_passages.h"

namespace parley {
namespace {

TopologyOptions checked(const TopologyOptions& options, const Footprint& footprint) {
  std::vector<std::string> problems = checkOptions(options, "topology");
  for (const std::string& problem : checkOptions(footprint, "footprint")) problems.push_back(problem);
  if (options.search != "astar" && options.search != "depth_first") {
    problems.push_back("topology: search: neither astar nor depth_first: " + options.search);
  }
  if (options.occupied_above >= options.evidence_limit || options.free_below <= -options.evidence_limit) {
    problems.push_back("topology: evidence_limit: does not reach occupied_above and free_below");
  }
  std::string text;
  for (const std::string& problem : problems) text += (text.empty() ? "" : "\n") + problem;
  if (!problems.empty()) throw std::invalid_argument(text);
  return options;
}

FieldShape shapeOf(const TopologyOptions& options, const Footprint& footprint) {
  FieldShape shape;
  shape.grown_radius = footprint.inscribedRadius() + options.margin;
  shape.reach = std::max(1.0, 2.0 * shape.grown_radius);
  shape.layer_distance = options.layer_distance;
  return shape;
}

constexpr double kLargestWindow = 200.0;  // [m] of a local map
constexpr int kStays = 3;                 // [s] that what came where nothing was is taken to stay while nobody looks

}  // namespace

struct Topology::Parts {
  Parts(const TopologyOptions& o, const Footprint& f)
      : options(checked(o, f)),
        footprint(f),
        shape(shapeOf(options, f)),
        map(options.resolution, options.extent, options.max_tiles),
        layers(options, shape.grown_radius),
        builder(options, shape),
        keeper(options) {}

  TopologyOptions options;
  Footprint footprint;
  FieldShape shape;
  TiledMap map;
  LayerStore layers;
  GraphBuilder builder;
  RouteKeeper keeper;
  Doubts doubts;
  ShutPassages shut_passages;
  double newest_scan = -1e18;  // [s]
  int refused = 0;
};

Topology::Topology(const TopologyOptions& options, const Footprint& footprint)
    : parts_(std::make_unique<Parts>(options, footprint)) {}
Topology::~Topology() = default;
Topology::Topology(Topology&&) noexcept = default;
Topology& Topology::operator=(Topology&&) noexcept = default;

void Topology::integrate(const ObstacleScan& scan, const Pose2& T_odom_base) {
  Parts& p = *parts_;
  if (!isUsable(scan, T_odom_base) || p.map.isOutside(T_odom_base.position())) {
    ++p.refused;
    return;
  }
  p.newest_scan = std::max(p.newest_scan, scan.stamp);
  addEvidence(p.map, drawScan(scan, T_odom_base, p.footprint, p.options.clear_margin, p.options.resolution), scan.stamp,
              p.options);
}

void Topology::setLayer(const LayerUpdate& layer) {
  if (!parts_->layers.set(parts_->map, layer)) ++parts_->refused;
}

void Topology::removeLayer(const std::string& origin) { parts_->layers.remove(parts_->map, origin); }

std::vector<SeenThrough> Topology::seenThrough() const {
  Parts& p = *parts_;
  std::vector<SeenThrough> found;
  for (const LayerUpdate* layer : p.layers.updates()) {
    for (const LayerContour& contour : layer->contours) {
      if (!layer->obstacle || !isSeenThrough(p.map, p.shape, layer->T_odom_peer, contour)) continue;
      found.push_back({layer->origin, contour.id, contour.version});
    }
  }
  return found;
}

void Topology::forget(const Refuted& outline) { forgetAlong(parts_->map, outline); }

bool Topology::shutPassage(const Eigen::Vector2d& p_odom) {
  return p_odom.allFinite() && parts_->shut_passages.shut(parts_->map, p_odom);
}

TopologyResult Topology::update() {
  Parts& p = *parts_;
  p.shut_passages.review(p.map);
  refreshField(p.map, p.shape);
  const GraphBuilder::Result built = p.builder.update(p.map, p.layers);
  TopologyResult result;
  result.changed = built.changed;
  result.added = built.added;
  result.removed = built.removed;
  result.vertices = p.builder.graph().vertexCount();
  result.edges = p.builder.graph().edgeCount();
  result.tiles = static_cast<int>(p.map.tiles().size());
  result.layers = p.layers.count();
  result.refused = p.refused;
  result.saturated = p.map.saturated() || p.layers.saturated() || p.builder.saturated();
  return result;
}

Route Topology::route(const Pose2& T_odom_base, const Eigen::Vector2d& goal_odom) {
  Parts& p = *parts_;
  if (!T_odom_base.isFinite() || !goal_odom.allFinite()) {
    ++p.refused;
    return {};
  }
  const Sight sight(p.map, p.options, p.shape);
  Route route = p.keeper.route(p.map, p.builder.graph(), sight, T_odom_base.position(), goal_odom);
  if (!route.exists()) p.shut_passages.openAll(p.map);
  p.doubts.consider(p.map, p.newest_scan, route.exists());
  return route;
}

LocalMap Topology::localMap(const Eigen::Vector2d& center, double size, double stamp) const {
  const Parts& p = *parts_;
  LocalMap local;
  local.stamp = stamp;
  local.frame.resolution = p.options.resolution;
  if (!(size > 0.0 && size <= kLargestWindow) || p.map.isOutside(center)) return local;
  const int cells = static_cast<int>(std::ceil(size / p.options.resolution));
  const int x0 = p.map.cellOf(center.x() - 0.5 * size), y0 = p.map.cellOf(center.y() - 0.5 * size);
  local.frame.origin = {x0 * p.options.resolution, y0 * p.options.resolution};
  local.frame.width = local.frame.height = cells;
  const int now = parts_->map.secondsOf(stamp);
  local.cells.assign(static_cast<std::size_t>(cells) * static_cast<std::size_t>(cells), CellState::kUnknown);
  forEachTile({x0, y0, x0 + cells, y0 + cells}, [&](int tx, int ty, const CellRect& part) {
    const Tile* tile = p.map.find(tx, ty);
    for (int y = part.y0; tile && y < part.y1; ++y) {
      CellState* row = local.cells.data() + static_cast<std::ptrdiff_t>(y - y0) * cells - x0;
      for (int x = part.x0; x < part.x1; ++x) {
        const std::size_t i = offsetOf(x, y);
        const std::uint8_t flags = tile->flags[i];
        const bool occupied = flags & kSeen ? flags & kOwn : flags & kFused;
        const bool may_have_gone = occupied && (flags & kCame) == kCame && tile->looked[i] + kStays < now;
        row[x] = may_have_gone   ? CellState::kUnknown
                 : occupied      ? CellState::kOccupied
                 : flags & kSeen ? CellState::kSeenFree
                                 : CellState::kUnknown;
      }
    }
  });
  return local;
}

const VisibilityGraph& Topology::graph() const {
  parts_->builder.measureEdges(parts_->map);
  return parts_->builder.graph();
}
std::vector<Contour> Topology::contours() const { return outlinesOf(parts_->map, kOwn); }
std::vector<Contour> Topology::fusedContours() const { return outlinesOf(parts_->map, kFused); }

void Topology::reset() { *parts_ = Parts(parts_->options, parts_->footprint); }

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#include "graph_builder.h"

#include <array>
#include <limits>
#include <optional>

namespace parley {
namespace {

constexpr double kTangentSlack = 0.15;  // [-] sine of the angle by which an edge may cut into the outline it should touch
constexpr double kMatchDistance = 0.3;  // [m] a corner that moved less keeps its name
constexpr double kMatchTurn = 0.7;      // [-] cosine of the angle a corner may turn and keep its name

bool sameProvenance(const Provenance& a, const Provenance& b) { return a.origin == b.origin && a.hops == b.hops; }

/// Whether what makes pairs with other corners is the same; direction and provenance may differ.
bool seesTheSame(const Vertex& a, const Vertex& b) {
  return a.position == b.position && a.previous == b.previous && a.next == b.next && a.kind == b.kind &&
         a.at_unknown == b.at_unknown;
}

/// An edge is as far off as the farther of its ends.
const Provenance& fartherOf(const Vertex& a, const Vertex& b) {
  return a.provenance.hops >= b.provenance.hops ? a.provenance : b.provenance;
}

/// Index of the corner in `candidates` (slots, -1 for taken) that `corner` goes on from; -1 if it is new.
int nearestMatch(const VisibilityGraph& graph, const std::vector<int>& candidates, const Vertex& corner) {
  int best = -1;
  double least = kMatchDistance;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (candidates[i] < 0) continue;
    const Vertex& old = graph.vertex(candidates[i]);
    const double distance = (old.position - corner.position).norm();
    if (distance >= least || old.kind != corner.kind || old.direction.dot(corner.direction) < kMatchTurn) continue;
    best = static_cast<int>(i);
    least = distance;
  }
  return best;
}

/// Blocks of a tile that lie along the side towards its neighbour at (dx, dy).
std::uint16_t blocksTowards(int dx, int dy) {
  std::uint16_t blocks = 0;
  for (int block = 0; block < 16; ++block) {
    const int x = block & 3, y = block >> 2;
    const bool in_x = dx == 0 || x == (dx < 0 ? 0 : 3), in_y = dy == 0 || y == (dy < 0 ? 0 : 3);
    if (in_x && in_y) blocks = static_cast<std::uint16_t>(blocks | 1U << block);
  }
  return blocks;
}

struct TouchedTiles {
  std::vector<Tile*> contours;  // contours may be others now: what changed is in them or right beside them
  std::vector<Tile*> corners;   // corners may be others now: contours here or in a tile beside may be
};

void sortUnique(std::vector<Tile*>& tiles) {
  std::sort(tiles.begin(), tiles.end(),
            [](const Tile* a, const Tile* b) { return a->ty != b->ty ? a->ty < b->ty : a->tx < b->tx; });
  tiles.erase(std::unique(tiles.begin(), tiles.end()), tiles.end());
}

template <class Visit>
void forEachAround(TiledMap& map, const Tile& tile, const Visit& visit) {
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      if (Tile* near = map.find(tile.tx + dx, tile.ty + dy)) visit(near, dx, dy);
    }
  }
}

/// In a fixed order. Who is behind a corner and whether it is at unseen space can change without any distance changing.
TouchedTiles touchedTiles(TiledMap& map) {
  TouchedTiles touched;
  for (const Tile* tile : map.changed()) {
    forEachAround(map, *tile, [&](Tile* near, int dx, int dy) {
      if (tile->changed_seen & blocksTowards(dx, dy)) touched.corners.push_back(near);
    });
    if (!tile->changed_field) continue;
    forEachAround(map, *tile, [&](Tile* near, int dx, int dy) {
      if (tile->changed_field & blocksTowards(dx, dy)) touched.contours.push_back(near);
    });
  }
  sortUnique(touched.contours);
  for (const Tile* tile : touched.contours) {
    forEachAround(map, *tile, [&](Tile* near, int, int) { touched.corners.push_back(near); });
  }
  sortUnique(touched.corners);
  return touched;
}

}  // namespace

GraphBuilder::Result GraphBuilder::update(TiledMap& map, const LayerStore& layers) {
  Result result;
  const ChangedBlocks changed(map, options_.clearance_cap);
  if (changed.empty()) return result;
  const TouchedTiles touched = touchedTiles(map);
  for (Tile* tile : touched.contours) tile->chains = traceTile(map, tile->tx, tile->ty, shape_, options_.simplify);
  const std::vector<int> fresh = matchCorners(map, touched.corners, layers, result);
  const bool edges_changed = refreshPairs(map, changed);
  std::vector<char> pending(static_cast<std::size_t>(graph_.slotCount()), 0);
  for (const int slot : fresh) pending[static_cast<std::size_t>(slot)] = 1;
  for (const int slot : fresh) {
    pending[static_cast<std::size_t>(slot)] = 0;
    connect(map, slot, pending);
  }
  map.forgetChanges();
  result.changed = edges_changed || result.added + result.removed > 0;
  return result;
}

/// The paper's MergeTopologies: corners found again stay, with their edges if nothing about them changed; others come and
/// go. Returns the slots of those whose edges have to be looked for.
std::vector<int> GraphBuilder::matchCorners(TiledMap& map, const std::vector<Tile*>& tiles, const LayerStore& layers,
                                            Result& result) {
  std::vector<int> fresh;
  for (Tile* tile : tiles) {
    std::vector<Vertex> found = cornersOf(map, *tile, shape_, options_.simplify, layers);
    std::vector<int> old = std::move(tile->vertices);
    tile->vertices.clear();
    std::vector<Vertex> moved;
    for (const Vertex& corner : found) {
      const auto same =
          std::find_if(old.begin(), old.end(), [&](int slot) { return slot >= 0 && seesTheSame(graph_.vertex(slot), corner); });
      if (same == old.end()) {
        moved.push_back(corner);
        continue;
      }
      keepVertex(*same, corner);
      tile->vertices.push_back(*same);
      *same = -1;
    }
    for (Vertex& corner : moved) {
      const int match = nearestMatch(graph_, old, corner);
      if (match >= 0) {
        int& slot = old[static_cast<std::size_t>(match)];
        corner.id = graph_.vertex(slot).id;
        corner.votes = graph_.vertex(slot).votes + 1;
        removeVertex(slot);
        slot = -1;
      } else {
        corner.id = next_id_++;
      }
    }
    for (const int slot : old) {
      if (slot < 0) continue;
      removeVertex(slot);
      ++result.removed;
    }
    for (const Vertex& corner : moved) {
      if (graph_.vertexCount() >= options_.max_vertices) {
        saturated_ = true;
        break;
      }
      const int slot = graph_.addVertex(corner);
      if (static_cast<std::size_t>(slot) >= pairs_of_.size()) pairs_of_.emplace_back();
      if (corner.at_unknown) at_unknown_.insert(std::lower_bound(at_unknown_.begin(), at_unknown_.end(), slot), slot);
      tile->vertices.push_back(slot);
      fresh.push_back(slot);
      ++result.added;
    }
  }
  return fresh;
}

/// Looks again at edges that lead past a change, and at pairs that were shut where something changed.
bool GraphBuilder::refreshPairs(TiledMap& map, const ChangedBlocks& changed) {
  const std::vector<int> freed = pairsNoLongerShut(map);
  bool any = !freed.empty();
  for (const int pair : passes_.pairsAt(changed, [this](const Watch& w) { return isVoid(w); })) {
    Pair& p = pairs_[static_cast<std::size_t>(pair)];
    const Eigen::Vector2d a = graph_.vertex(p.a).position, b = graph_.vertex(p.b).position;
    const ChangedBlocks::Touch touch = changed.touchOf(a, b);
    if (touch.bearing == ChangedBlocks::kUntouched) continue;
    any = true;
    graph_.edge(p.edge).measured = false;
    if (touch.bearing != ChangedBlocks::kPassage) continue;
    const Walk walk = Sight(map, options_, shape_).walk(a, b, touch.from, touch.to);  // elsewhere it is open as before
    if (!walk.open) shut(map, pair, walk.blocked_at);
  }
  for (const int pair : freed) settle(map, pair);
  return any;
}

std::vector<int> GraphBuilder::slotsWithin(const TiledMap& map, const CellRect& cells) const {
  std::vector<int> slots;
  forEachTile(cells, [&](int tx, int ty, const CellRect&) {
    const Tile* tile = map.find(tx, ty);
    if (tile) slots.insert(slots.end(), tile->vertices.begin(), tile->vertices.end());
  });
  return slots;
}

/// Pairs whose watched cell is passable now; takes them off the watch.
std::vector<int> GraphBuilder::pairsNoLongerShut(TiledMap& map) {
  std::vector<int> freed;
  for (Tile* tile : map.changed()) {
    if (!tile->changed_passable) continue;
    tile->watches.sweep([&](const Watch& watch) {
      if (isVoid(watch)) return true;
      const Eigen::Vector2i& cell = pairs_[static_cast<std::size_t>(watch.pair)].blocked_at;
      const bool shut = !(map.flags(cell.x(), cell.y()) & kPassable);
      if (!shut) freed.push_back(watch.pair);
      return !shut;
    });
  }
  return freed;
}

/// What was found in the way of pairs of one corner, by bearing: it is likely to be in the way of the next one there too.
class GraphBuilder::Shadows {
 public:
  std::optional<Eigen::Vector2i>& towards(const Eigen::Vector2d& ray) {
    const double turn = ray.y() < 0.0 ? 3.0 + ray.x() : 1.0 - ray.x();  // grows with the bearing, 0 to 4
    return cells_[std::min(cells_.size() - 1, static_cast<std::size_t>(turn * 0.25 * static_cast<double>(cells_.size())))];
  }

 private:
  std::array<std::optional<Eigen::Vector2i>, 32> cells_;
};

/// Makes the pairs of a new corner with all others but those pending, which will make theirs with it.
void GraphBuilder::connect(TiledMap& map, int slot, const std::vector<char>& pending) {
  Shadows shadows;
  const Vertex& vertex = graph_.vertex(slot);
  const int x = map.cellOf(vertex.position.x()), y = map.cellOf(vertex.position.y());
  const auto length = [&](int other) { return (graph_.vertex(other).position - vertex.position).norm(); };
  for (const int other : slotsWithin(map, CellRect{x, y, x + 1, y + 1}.grown(cellsOf(options_.max_edge)))) {
    if (!pending[static_cast<std::size_t>(other)] && length(other) <= options_.max_edge) tryPair(map, slot, other, shadows);
  }
  if (!vertex.at_unknown) return;
  for (const int other : at_unknown_) {
    if (!pending[static_cast<std::size_t>(other)] && length(other) > options_.max_edge) tryPair(map, slot, other, shadows);
  }
}

void GraphBuilder::tryPair(TiledMap& map, int slot, int other, Shadows& shadows) {
  const Vertex& vertex = graph_.vertex(slot);
  const Vertex& end = graph_.vertex(other);
  const Eigen::Vector2d way = end.position - vertex.position;
  const double length = way.norm();
  if (length < 1e-6) return;
  const Eigen::Vector2d ray = way / length;
  if (!isTangent(vertex, ray, kTangentSlack) || !isTangent(end, ray, kTangentSlack)) return;
  int pair = static_cast<int>(pairs_.size());
  if (!free_pairs_.empty()) {
    pair = free_pairs_.back();
    free_pairs_.pop_back();
  } else if (pair < options_.max_pairs) {
    pairs_.emplace_back();
  } else {
    saturated_ = true;
    return;
  }
  Pair& made = pairs_[static_cast<std::size_t>(pair)];
  made.a = slot;
  made.b = other;
  for (const int of : {slot, other}) {
    pairs_of_[static_cast<std::size_t>(of)].add({pair, made.life}, [this](const Watch& w) { return isOfAnother(w); });
  }
  std::optional<Eigen::Vector2i>& shadow = shadows.towards(ray);
  if (shadow) shadow = Sight(map, options_, shape_).shutNear(vertex.position, end.position, *shadow);
  if (shadow) {
    shut(map, pair, *shadow);
  } else if (!settle(map, pair)) {
    shadow = made.blocked_at;
  }
}

/// Walks the way of a pair without an edge: makes its edge, or sets its watch. Whether it is open.
bool GraphBuilder::settle(TiledMap& map, int pair) {
  Pair& p = pairs_[static_cast<std::size_t>(pair)];
  const Sight sight(map, options_, shape_);
  const Vertex& a = graph_.vertex(p.a);
  const Vertex& b = graph_.vertex(p.b);
  const Walk walk = sight.walk(a.position, b.position);
  if (!walk.open) {
    shut(map, pair, walk.blocked_at);
    return false;
  }
  ++p.version;
  Edge edge;
  edge.from = p.a;
  edge.to = p.b;
  edge.length = (b.position - a.position).norm();
  edge.provenance = fartherOf(a, b);
  p.edge = graph_.addEdge(edge);
  passes_.add({pair, p.version}, a.position, b.position, [this](const Watch& w) { return isVoid(w); });
  return true;
}

void GraphBuilder::measureEdges(const TiledMap& map) {
  const Sight sight(map, options_, shape_);
  for (int slot = 0; slot < graph_.edgeSlotCount(); ++slot) measureEdge(graph_, slot, sight);
}

/// Takes a pair's edge away, if there is one, and watches the cell that is in its way.
void GraphBuilder::shut(TiledMap& map, int pair, const Eigen::Vector2i& blocked_at) {
  Pair& p = pairs_[static_cast<std::size_t>(pair)];
  ++p.version;
  if (p.edge >= 0) graph_.removeEdge(p.edge);
  p.edge = -1;
  p.blocked_at = blocked_at;
  Tile& tile = *map.find(tileOf(blocked_at.x()), tileOf(blocked_at.y()));  // only cells of tiles block
  tile.watches.add({pair, p.version}, [this](const Watch& w) { return isVoid(w); });
}

/// A corner found again; its edges stay.
void GraphBuilder::keepVertex(int slot, const Vertex& corner) {
  Vertex& vertex = graph_.vertex(slot);
  ++vertex.votes;
  vertex.direction = corner.direction;
  if (sameProvenance(vertex.provenance, corner.provenance)) return;
  vertex.provenance = corner.provenance;
  for (const Watch& entry : pairs_of_[static_cast<std::size_t>(slot)].entries) {
    if (isOfAnother(entry)) continue;
    const Pair& pair = pairs_[static_cast<std::size_t>(entry.pair)];
    if (pair.edge >= 0) graph_.edge(pair.edge).provenance = fartherOf(graph_.vertex(pair.a), graph_.vertex(pair.b));
  }
}

void GraphBuilder::removeVertex(int slot) {
  WatchList& pairs = pairs_of_[static_cast<std::size_t>(slot)];
  for (const Watch& entry : pairs.entries) {
    if (!isOfAnother(entry)) removePair(entry.pair);
  }
  pairs = {};
  const auto at_unknown = std::lower_bound(at_unknown_.begin(), at_unknown_.end(), slot);
  if (at_unknown != at_unknown_.end() && *at_unknown == slot) at_unknown_.erase(at_unknown);
  graph_.removeVertex(slot);
}

void GraphBuilder::removePair(int pair) {
  Pair& p = pairs_[static_cast<std::size_t>(pair)];
  if (p.edge >= 0) graph_.removeEdge(p.edge);
  p.a = p.b = p.edge = -1;
  ++p.version;
  ++p.life;
  free_pairs_.push_back(pair);
}

void GraphBuilder::clear() { *this = GraphBuilder(options_, shape_); }

}  // namespace parley

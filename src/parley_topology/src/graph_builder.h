// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "changed_blocks.h"
#include "corners.h"
#include "layer_store.h"
#include "parley_topology/visibility_graph.h"
#include "pass_index.h"
#include "sight.h"
#include "tiled_map.h"

namespace parley {

/// Keeps the visibility graph equal to what the map says, at a cost that goes with what changed.
///
/// Every pair of corners that see each other along both their tangents is kept, open or not. A pair that is not open is
/// watched at the one cell that was found in its way and looked at again when that cell changes; an open one is watched
/// in all tiles it passes.
class GraphBuilder {
 public:
  GraphBuilder(const TopologyOptions& options, const FieldShape& shape)
      : options_(options), shape_(shape), passes_(options.resolution) {}

  struct Result {
    int added = 0, removed = 0;
    bool changed = false;
  };

  /// Brings the graph up to date with the blocks noted in `changed_field`, and clears these.
  Result update(TiledMap& map, const LayerStore& layers);

  /// Edges are measured when a search asks for them, `measureEdges` measures the rest.
  VisibilityGraph& graph() { return graph_; }
  void measureEdges(const TiledMap& map);
  bool saturated() const { return saturated_; }
  void clear();

 private:
  struct Pair {
    int a = -1, b = -1;         // slots of vertices; a < 0 is an empty slot
    int edge = -1;              // slot of the edge if open
    std::uint32_t version = 0;  // of what is known of the way
    std::uint32_t life = 0;     // of the slot: raised when the pair is removed
    Eigen::Vector2i blocked_at = Eigen::Vector2i::Zero();
  };

  std::vector<int> matchCorners(TiledMap& map, const std::vector<Tile*>& tiles, const LayerStore& layers, Result& result);
  bool refreshPairs(TiledMap& map, const ChangedBlocks& changed);
  std::vector<int> pairsNoLongerShut(TiledMap& map);
  void connect(TiledMap& map, int slot, const std::vector<char>& pending);
  class Shadows;
  void tryPair(TiledMap& map, int slot, int other, Shadows& shadows);
  int cellsOf(double length) const { return static_cast<int>(std::ceil(length / options_.resolution)); }
  std::vector<int> slotsWithin(const TiledMap& map, const CellRect& cells) const;
  bool settle(TiledMap& map, int pair);
  void shut(TiledMap& map, int pair, const Eigen::Vector2i& blocked_at);
  bool isVoid(const Watch& watch) const { return pairs_[static_cast<std::size_t>(watch.pair)].version != watch.version; }
  bool isOfAnother(const Watch& entry) const { return pairs_[static_cast<std::size_t>(entry.pair)].life != entry.version; }
  void keepVertex(int slot, const Vertex& corner);
  void removeVertex(int slot);
  void removePair(int pair);

  TopologyOptions options_;
  FieldShape shape_;
  VisibilityGraph graph_;
  std::vector<Pair> pairs_;
  std::vector<int> free_pairs_;
  PassIndex passes_;
  std::vector<WatchList> pairs_of_;  // by slot of a vertex, with lives
  std::vector<int> at_unknown_;      // slots of vertices at unseen space, in order
  int next_id_ = 0;
  bool saturated_ = false;
};

}  // namespace parley

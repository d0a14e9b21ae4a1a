// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "parley_topology/contour.h"
#include "parley_topology/topology_options.h"
#include "tiled_map.h"

namespace parley {

/// A cell that a layer covers.
struct LayerCell {
  std::uint64_t key = 0;
  std::uint16_t told = 0;  // [s] of the map's clock

  bool operator==(const LayerCell& o) const { return key == o.key && told == o.told; }
  /// Of the entries of one cell the newest comes first.
  bool operator<(const LayerCell& o) const { return key != o.key ? key < o.key : told > o.told; }
};

/// Peers' outlines, one layer per origin, drawn into the map's counts of covering layers and taken out again exactly.
class LayerStore {
 public:
  /// Outlines that are not confirmed are drawn `reach` [m] to each side: what comes that near pays for it.
  LayerStore(const TopologyOptions& options, double reach) : options_(options), reach_(reach) {}

  /// False if refused: a pose that is not finite, no origin, or no room for another layer.
  bool set(TiledMap& map, const LayerUpdate& layer);
  /// False if there was none.
  bool remove(TiledMap& map, const std::string& origin);

  int count() const { return static_cast<int>(layers_.size()); }
  bool saturated() const { return saturated_; }
  /// All layers that are held.
  std::vector<const LayerUpdate*> updates() const;
  /// The least indirect layer that holds a cell occupied; nullptr if none does.
  const Provenance* ownerOf(int x, int y) const;
  void clear() { *this = LayerStore(options_, reach_); }

 private:
  struct Layer {
    LayerUpdate update;
    Provenance provenance;
    std::vector<LayerCell> cells;  // by key, each once
  };

  std::vector<LayerCell> draw(TiledMap& map, const LayerUpdate& layer);
  void takeOut(TiledMap& map, const std::vector<LayerCell>& cells, const Layer& layer);

  TopologyOptions options_;
  double reach_;
  bool saturated_ = false;
  std::map<std::string, Layer> layers_;
};

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#include "layer_store.h"

#include <gtest/gtest.h>

#include <limits>

namespace parley {
namespace {

LayerUpdate wall(const std::string& origin, double x, int hops = 1) {
  LayerUpdate layer;
  layer.origin = origin;
  layer.hops = hops;
  layer.contours.push_back({{{x, -1.0}, {x, 1.0}}, false});
  return layer;
}

int hardCells(const TiledMap& map) {
  int sum = 0;
  for (const auto& tile : map.tiles()) {
    if (!tile->layers) continue;
    for (const std::uint8_t count : tile->layers->hard) sum += count;
  }
  return sum;
}

int softCells(const TiledMap& map) {
  int sum = 0;
  for (const auto& tile : map.tiles()) {
    if (!tile->layers) continue;
    for (const std::uint8_t count : tile->layers->soft) sum += count;
  }
  return sum;
}

struct Store {
  TopologyOptions options;
  TiledMap map{options.resolution, options.extent, options.max_tiles};
  LayerStore layers{options, 0.25};
};

}  // namespace

TEST(LayerStore, drawsAnOutlineWithoutGaps) {
  Store s;
  LayerUpdate layer = wall("bob", 0.0);
  layer.T_odom_peer = {5.0, 2.0, 0.6};
  ASSERT_TRUE(s.layers.set(s.map, layer));
  for (double t = -1.0; t <= 1.0; t += 0.01) {
    const Eigen::Vector2d p = layer.T_odom_peer * Eigen::Vector2d(0.0, t);
    int near = 0;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const int x = s.map.cellOf(p.x()) + dx, y = s.map.cellOf(p.y()) + dy;
        near += s.map.find(tileOf(x), tileOf(y))->layers->hard[offsetOf(x, y)];
      }
    }
    EXPECT_GT(near, 0) << t;
  }
  EXPECT_LT(hardCells(s.map), 80);
}

TEST(LayerStore, closedOutlinesHaveTheirLastSide) {
  Store s;
  LayerUpdate layer;
  layer.origin = "bob";
  layer.contours.push_back({{{0.02, 0.02}, {1.02, 0.02}, {1.02, 1.02}}, false});
  s.layers.set(s.map, layer);
  const int open = hardCells(s.map);
  layer.contours[0].closed = true;
  s.layers.set(s.map, layer);
  EXPECT_GT(hardCells(s.map), open + 15);
}

TEST(LayerStore, removalIsExactWithLayersOnTopOfEachOther) {
  Store s;
  s.layers.set(s.map, wall("ann", 1.0));
  const int ann = hardCells(s.map);
  s.layers.set(s.map, wall("bob", 1.0));
  s.layers.set(s.map, wall("cid", 1.01));
  EXPECT_EQ(s.layers.count(), 3);
  EXPECT_TRUE(s.layers.remove(s.map, "bob"));
  EXPECT_FALSE(s.layers.remove(s.map, "bob"));
  EXPECT_TRUE(s.layers.remove(s.map, "cid"));
  EXPECT_EQ(hardCells(s.map), ann);
  EXPECT_TRUE(s.layers.remove(s.map, "ann"));
  EXPECT_EQ(hardCells(s.map), 0);
}

TEST(LayerStore, aNewPoseDrawsAgain) {
  Store s;
  LayerUpdate layer = wall("bob", 1.0);
  s.layers.set(s.map, layer);
  layer.T_odom_peer.x = 3.0;
  s.layers.set(s.map, layer);
  const auto hard = [&](double x) {
    const Tile* tile = s.map.find(tileOf(s.map.cellOf(x)), 0);
    return tile && tile->layers ? tile->layers->hard[offsetOf(s.map.cellOf(x), 3)] : 0;
  };
  EXPECT_EQ(hard(1.01), 0);
  EXPECT_EQ(hard(4.01), 1);
}

TEST(LayerStore, theSameAgainChangesNothing) {
  Store s;
  s.layers.set(s.map, wall("bob", 1.0));
  for (const auto& tile : s.map.tiles()) tile->changed_cells = 0;
  LayerUpdate again = wall("bob", 1.0);
  again.stamp = 7.0;
  again.hops = 2;
  EXPECT_TRUE(s.layers.set(s.map, again));
  for (const auto& tile : s.map.tiles()) EXPECT_EQ(tile->changed_cells, 0);
  EXPECT_EQ(s.layers.ownerOf(s.map.cellOf(1.0), 0)->hops, 2);
}

TEST(LayerStore, tentativeOutlinesAreWideAndDoNotBlock) {
  Store s;
  LayerUpdate layer = wall("bob", 1.0);
  layer.obstacle = false;
  s.layers.set(s.map, layer);
  EXPECT_EQ(hardCells(s.map), 0);
  EXPECT_GT(softCells(s.map), 400);
  EXPECT_EQ(s.layers.ownerOf(s.map.cellOf(1.0), 0), nullptr);
  s.layers.remove(s.map, "bob");
  EXPECT_EQ(softCells(s.map), 0);
}

TEST(LayerStore, theLeastIndirectOwns) {
  Store s;
  s.layers.set(s.map, wall("ann", 1.0, 3));
  s.layers.set(s.map, wall("bob", 1.0, 1));
  s.layers.set(s.map, wall("cid", 1.0, 2));
  ASSERT_NE(s.layers.ownerOf(s.map.cellOf(1.0), 0), nullptr);
  EXPECT_EQ(s.layers.ownerOf(s.map.cellOf(1.0), 0)->origin, "bob");
  EXPECT_EQ(s.layers.ownerOf(s.map.cellOf(2.0), 0), nullptr);
}

TEST(LayerStore, refusesWhatItCannotUse) {
  Store s;
  EXPECT_FALSE(s.layers.set(s.map, wall("", 1.0)));
  LayerUpdate lost = wall("bob", 1.0);
  lost.T_odom_peer.yaw = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(s.layers.set(s.map, lost));
  EXPECT_TRUE(s.layers.set(s.map, wall("bob", std::numeric_limits<double>::infinity())));
  EXPECT_TRUE(s.layers.set(s.map, wall("cid", 1e6)));
  EXPECT_EQ(hardCells(s.map), 0);
  LayerUpdate odd;
  odd.origin = "dan";
  odd.contours = {{{}, true}, {{{1.0, 1.0}}, true}};
  EXPECT_TRUE(s.layers.set(s.map, odd));
  EXPECT_EQ(hardCells(s.map), 1);
}

TEST(LayerStore, boundsAreMetAndTold) {
  TopologyOptions options;
  options.max_layers = 2;
  options.max_layer_contours = 1;
  options.max_layer_cells = 100;
  TiledMap map(options.resolution, options.extent, 4);
  LayerStore layers(options, 0.25);
  EXPECT_TRUE(layers.set(map, wall("ann", 1.0)));
  EXPECT_FALSE(layers.saturated());
  LayerUpdate two = wall("bob", 1.0);
  two.contours.push_back(two.contours.front());
  EXPECT_TRUE(layers.set(map, two));
  EXPECT_TRUE(layers.saturated());
  EXPECT_FALSE(layers.set(map, wall("cid", 1.0)));
  EXPECT_TRUE(layers.set(map, wall("ann", 2.0)));
  layers.clear();
  EXPECT_FALSE(layers.saturated());
  LayerUpdate long_wall;
  long_wall.origin = "dan";
  long_wall.contours.push_back({{{-200.0, 0.0}, {200.0, 0.0}}, false});
  EXPECT_TRUE(layers.set(map, long_wall));
  EXPECT_TRUE(layers.saturated());
  EXPECT_LE(map.tiles().size(), 4U);
  EXPECT_TRUE(layers.remove(map, "dan"));
}

}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

// SPDX-License-Identifier: BSD-3-Clause
#include "clearance_field.h"

#include <gtest/gtest.h>

#include <random>

namespace parley {
namespace {

void setOwn(TiledMap& map, int x, int y, bool occupied) {
  Tile& tile = *map.ensure(tileOf(x), tileOf(y));
  std::uint8_t& flags = tile.flags[offsetOf(x, y)];
  flags = static_cast<std::uint8_t>((flags | kSeen | kOwn) & ~(occupied ? 0 : kOwn));
  tile.changed_cells = static_cast<std::uint16_t>(tile.changed_cells | blockBit(x, y));
  map.note(tile);
}

}  // namespace

TEST(ClearanceField, distancesAreThoseToTheNearestObstacle) {
  std::mt19937 random(11);
  std::uniform_int_distribution<int> cell(-90, 90);
  TiledMap map(0.05, 50.0, 100);
  const FieldShape shape;
  std::vector<Eigen::Vector2i> obstacles;
  for (int round = 0; round < 10; ++round) {  // some at a time: windows must leave what the whole would
    for (int k = 0; k < 5; ++k) {
      obstacles.emplace_back(cell(random), cell(random));
      setOwn(map, obstacles.back().x(), obstacles.back().y(), true);
    }
    refreshField(map, shape);
  }
  for (int y = -110; y <= 110; y += 3) {
    for (int x = -110; x <= 110; x += 3) {
      double least = 1e9;
      for (const Eigen::Vector2i& o : obstacles)
        least = std::min(least, 0.05 * (o - Eigen::Vector2i(x, y)).cast<double>().norm());
      const double expected = std::min(least, shape.reach);
      EXPECT_NEAR(metersOf(map.distance(x, y), shape.reach), expected, 0.03 * expected + 0.004) << x << " " << y;
      if (std::abs(least - shape.grown_radius) > 0.02) {
        EXPECT_EQ((map.flags(x, y) & kWide) != 0, least > shape.grown_radius) << x << " " << y;
      }
    }
  }
}

TEST(ClearanceField, whatGoesLeavesNothingBehind) {
  TiledMap map(0.05, 50.0, 100);
  const FieldShape shape;
  for (int x = 10; x < 90; ++x) setOwn(map, x, 60, true);
  refreshField(map, shape);
  EXPECT_FALSE(map.flags(50, 62) & kPassable);
  for (int x = 10; x < 90; ++x) setOwn(map, x, 60, false);
  refreshField(map, shape);
  for (const auto& tile : map.tiles()) {
    for (std::size_t i = 0; i < kTileCells; ++i) {
      EXPECT_EQ(tile->distance[i], kFarAway);
      EXPECT_EQ(tile->flags[i] & ~kSeen, kFlagsOfNothing);
    }
  }
}

TEST(ClearanceField, gapsNarrowerThanTwiceTheGrownRadiusAreShut) {
  const FieldShape shape{0.22, 1.0, 0.1};
  for (int gap = 6; gap <= 12; ++gap) {  // [cells] between the middles of the posts' last cells
    TiledMap map(0.05, 50.0, 100);
    for (int x = -40; x <= 40; ++x) {
      if (x <= 0 || x >= gap) setOwn(map, x, 0, true);
    }
    refreshField(map, shape);
    bool open = false;
    for (int x = 0; x <= gap; ++x) open = open || (map.flags(x, 0) & kPassable);
    EXPECT_EQ(open, gap >= 10) << gap << " cells";
  }
}

TEST(ClearanceField, changesAreToldByBlock) {
  TiledMap map(0.05, 50.0, 100);
  const FieldShape shape;
  setOwn(map, 8, 8, true);
  setOwn(map, 60, 60, true);
  refreshField(map, shape);
  Tile& tile = *map.find(0, 0);
  EXPECT_EQ(tile.changed_cells, 0);
  EXPECT_TRUE(tile.changed_field & blockBit(8, 8));
  map.forgetChanges();
  setOwn(map, 60, 60, true);  // nothing new
  refreshField(map, shape);
  EXPECT_EQ(tile.changed_field, 0);
  setOwn(map, 61, 60, true);  // beside one that is there
  refreshField(map, shape);
  EXPECT_FALSE(tile.changed_field & blockBit(8, 8));
  EXPECT_TRUE(tile.changed_field & blockBit(61, 60));
}

}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

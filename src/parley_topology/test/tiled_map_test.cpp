// SPDX-License-Identifier: BSD-3-Clause
#include "tiled_map.h"

#include <gtest/gtest.h>

#include <limits>

namespace parley {

TEST(TiledMap, isEmptySpaceBeforeAnythingIsSeen) {
  const TiledMap map(0.05, 100.0, 10);
  EXPECT_EQ(map.flags(-7, 1234), kFlagsOfNothing);
  EXPECT_EQ(map.distance(0, 0), kFarAway);
  EXPECT_EQ(map.find(0, 0), nullptr);
}

TEST(TiledMap, growsInEveryDirectionAndKeepsTiles) {
  TiledMap map(0.05, 100.0, 10);
  Tile* south_west = map.ensure(-1, -2);
  Tile* north_east = map.ensure(3, 5);
  ASSERT_NE(south_west, nullptr);
  ASSERT_NE(north_east, nullptr);
  south_west->flags[offsetOf(-1, -128)] = kSeen;
  EXPECT_EQ(map.flags(-1, -128), kSeen);
  EXPECT_EQ(map.flags(-2, -128), kFlagsOfNothing);
  EXPECT_EQ(map.ensure(-1, -2), south_west);
  EXPECT_EQ(map.tiles().size(), 2U);
  EXPECT_FALSE(map.saturated());
}

TEST(TiledMap, refusesTilesBeyondItsBounds) {
  TiledMap map(0.05, 100.0, 2);
  EXPECT_NE(map.ensure(0, 0), nullptr);
  EXPECT_EQ(map.ensure(1000, 0), nullptr);
  EXPECT_TRUE(map.saturated());
  map.clear();
  EXPECT_FALSE(map.saturated());
  EXPECT_NE(map.ensure(0, 0), nullptr);
  EXPECT_NE(map.ensure(1, 0), nullptr);
  EXPECT_EQ(map.ensure(2, 0), nullptr);
  EXPECT_TRUE(map.saturated());
  EXPECT_NE(map.ensure(1, 0), nullptr);
}

TEST(TiledMap, knowsWhatLiesOutside) {
  const TiledMap map(0.05, 100.0, 2);
  EXPECT_FALSE(map.isOutside({99.0, -99.0}));
  EXPECT_TRUE(map.isOutside({0.0, 101.0}));
  EXPECT_TRUE(map.isOutside({std::numeric_limits<double>::quiet_NaN(), 0.0}));
}

TEST(TiledMap, cellsAndCoordinatesAgree) {
  const TiledMap map(0.05, 100.0, 2);
  for (int cell : {-2000, -65, -64, -1, 0, 1, 63, 64, 1999}) EXPECT_EQ(map.cellOf(map.centerOf(cell)), cell);
  EXPECT_EQ(tileOf(-1), -1);
  EXPECT_EQ(tileOf(64), 1);
}

TEST(ForEachTile, coversARectangleOnce) {
  const CellRect rect{-70, -3, 65, 130};
  long covered = 0;
  forEachTile(rect, [&](int tx, int ty, const CellRect& part) {
    EXPECT_FALSE(part.empty());
    EXPECT_EQ(tileOf(part.x0), tx);
    EXPECT_EQ(tileOf(part.y1 - 1), ty);
    covered += static_cast<long>(part.width()) * part.height();
  });
  EXPECT_EQ(covered, static_cast<long>(rect.width()) * rect.height());
}

}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

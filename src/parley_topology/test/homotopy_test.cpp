// SPDX-License-Identifier: BSD-3-Clause
#include "homotopy.h"

#include <gtest/gtest.h>

namespace parley {
namespace {

using Way = std::vector<Eigen::Vector2d>;

/// A map whose only content is obstacles at points.
TiledMap mapOf(const std::vector<Eigen::Vector2d>& obstacles) {
  TiledMap map(0.05, 100.0, 100);
  for (const Eigen::Vector2d& p : obstacles) {
    Chain chain;
    chain.core = p;
    map.ensure(tileOf(map.cellOf(p.x())), tileOf(map.cellOf(p.y())))->chains.push_back(chain);
  }
  return map;
}

}  // namespace

TEST(WindingNumber, countsTurns) {
  const Way square{{0, 0}, {2, 0}, {2, 2}, {0, 2}};
  EXPECT_EQ(windingNumber(square, {1, 1}), 1);
  EXPECT_EQ(windingNumber({square.rbegin(), square.rend()}, {1, 1}), -1);
  EXPECT_EQ(windingNumber(square, {3, 1}), 0);
  EXPECT_EQ(windingNumber(square, {-1, 1}), 0);
  Way twice = square;
  twice.insert(twice.end(), square.begin(), square.end());
  EXPECT_EQ(windingNumber(twice, {1, 1}), 2);
  EXPECT_EQ(windingNumber({{0, 0}, {4, 0}, {0, 0}, {0, 4}, {0, 0}}, {1, 1}), 0);
}

TEST(SameClass, comparesSidesOfObstacles) {
  const TiledMap map = mapOf({{5, 0}, {5, 6}});
  const Way below{{0, 0}, {5, -1}, {10, 0}};
  const Way above{{0, 0}, {5, 1}, {10, 0}};
  const Way further_above{{0, 0}, {3, 1}, {5, 5}, {8, 2}, {10, 0}};
  const Way over_both{{0, 0}, {5, 7}, {10, 0}};
  EXPECT_TRUE(sameClass(map, below, below));
  EXPECT_FALSE(sameClass(map, below, above));
  EXPECT_TRUE(sameClass(map, above, further_above));
  EXPECT_FALSE(sameClass(map, above, over_both));
  EXPECT_FALSE(sameClass(map, over_both, below));
}

TEST(SameClass, partsInCommonDoNotCount) {
  const TiledMap map = mapOf({{5, 0}, {12, 0.5}});
  const Way a{{0, 0}, {5, 1}, {10, 0}, {11, 2}, {14, 0}};
  const Way b{{0, 0}, {5, 1}, {10, 0}, {11, -1}, {14, 0}};
  EXPECT_FALSE(sameClass(map, a, b));
  EXPECT_TRUE(sameClass(mapOf({{5, 0}}), a, b));
}

TEST(SameClass, aSpurBackOntoTheWayDoesNotCount) {
  const TiledMap map = mapOf({{5, 0}});
  const Way driven{{3, 0.6}, {0, 0}, {5, 1}, {10, 0}};
  const Way fresh{{3, 0.6}, {5, 1}, {10, 0}};
  EXPECT_TRUE(sameClass(map, driven, fresh));
  EXPECT_FALSE(sameClass(map, driven, {{3, 0.6}, {5, -1}, {10, 0}}));
}

TEST(SameClass, onePointWaysAreTheSame) {
  EXPECT_TRUE(sameClass(mapOf({{5, 0}}), {{0, 0}, {1, 0}}, {{0, 0}, {1, 0}}));
}

}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

// SPDX-License-Identifier: BSD-3-Clause
#include "homotopy.h"

#include <gtest/gtest.h>

namespace parley {
namespace {

using Way = std::vector<Eigen::Vector2d>;

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
  const Way obstacles{{5, 0}, {5, 6}};
  const Way below{{0, 0}, {5, -1}, {10, 0}};
  const Way above{{0, 0}, {5, 1}, {10, 0}};
  const Way further_above{{0, 0}, {3, 1}, {5, 5}, {8, 2}, {10, 0}};
  const Way over_both{{0, 0}, {5, 7}, {10, 0}};
  EXPECT_TRUE(sameClass(obstacles, below, below));
  EXPECT_FALSE(sameClass(obstacles, below, above));
  EXPECT_TRUE(sameClass(obstacles, above, further_above));
  EXPECT_FALSE(sameClass(obstacles, above, over_both));
  EXPECT_FALSE(sameClass(obstacles, over_both, below));
}

TEST(SameClass, partsInCommonDoNotCount) {
  const Way obstacles{{5, 0}, {12, 0.5}};
  const Way a{{0, 0}, {5, 1}, {10, 0}, {11, 2}, {14, 0}};
  const Way b{{0, 0}, {5, 1}, {10, 0}, {11, -1}, {14, 0}};
  EXPECT_FALSE(sameClass(obstacles, a, b));
  EXPECT_TRUE(sameClass({{5, 0}}, a, b));
}

TEST(SameClass, aSpurBackOntoTheWayDoesNotCount) {
  const Way obstacles{{5, 0}};
  const Way driven{{3, 0.6}, {0, 0}, {5, 1}, {10, 0}};
  const Way fresh{{3, 0.6}, {5, 1}, {10, 0}};
  EXPECT_TRUE(sameClass(obstacles, driven, fresh));
  EXPECT_FALSE(sameClass(obstacles, driven, {{3, 0.6}, {5, -1}, {10, 0}}));
}

TEST(ObstaclePoints, areThoseOfTheChains) {
  TiledMap map(0.05, 100.0, 100);
  Chain chain;
  chain.core = {1.0, 2.0};
  map.ensure(0, 0)->chains.push_back(chain);
  chain.core = {-1.0, 2.0};
  map.ensure(-1, 0)->chains.push_back(chain);
  EXPECT_EQ(obstaclePoints(map), (Way{{1.0, 2.0}, {-1.0, 2.0}}));
}

TEST(SameClass, onePointWaysAreTheSame) { EXPECT_TRUE(sameClass({{5, 0}}, {{0, 0}, {1, 0}}, {{0, 0}, {1, 0}})); }

}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

// SPDX-License-Identifier: BSD-3-Clause
#include "parley_sim/shortest_path.h"

#include <gtest/gtest.h>

#include <cmath>

#include "parley_geometry/angles.h"
#include "worlds.h"

namespace parley::sim {
namespace {

constexpr double kRadius = 0.25;  // [m]

/// From outside a disc of radius r at the origin round it: tangent, arc, tangent. [m]
double roundADisc(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double r) {
  const double between = std::acos(a.normalized().dot(b.normalized()));
  const double arc = between - std::acos(r / a.norm()) - std::acos(r / b.norm());
  return std::sqrt(a.squaredNorm() - r * r) + std::sqrt(b.squaredNorm() - r * r) + r * std::max(0.0, arc);
}

void expectWithin(const World& world, const Eigen::Vector2d& start, const Eigen::Vector2d& goal, double truth) {
  const auto length = shortestLength(world, start, goal, kRadius);
  ASSERT_TRUE(length.has_value());
  EXPECT_LE(*length, 1.02 * truth);
  EXPECT_GE(*length, 0.998 * truth);
}

TEST(ShortestPathTest, straightWhereNothingIsInTheWay) {
  const World world = emptyWorld(20, 20);
  for (const double angle : {0.0, 0.2, 0.39, 0.5, kPi / 4, 1.3}) {
    const Eigen::Vector2d goal = Eigen::Vector2d(2, 2) + 15.0 * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    const auto length = shortestLength(world, {2, 2}, goal, kRadius);
    ASSERT_TRUE(length.has_value());
    EXPECT_NEAR(*length, 15.0, 1e-9);
  }
  EXPECT_NEAR(*shortestLength(world, {2, 2}, {2, 2}, kRadius), 0.0, 1e-12);
}

TEST(ShortestPathTest, roundTheEndOfAWall) {
  // a wall from below to y = 5, 0.1 m thick; the two upper corners are at (10 -+ 0.05, 5)
  const World world = drawnWorld(20, 20, 0.05, [](double x, double y) { return std::abs(x - 10.0) < 0.05 && y < 5.0; });
  for (const double x : {8.0, 5.0, 2.0}) {
    for (const double y : {1.0, 3.0, 4.5}) {
      const Eigen::Vector2d start(x, y), goal(20.0 - x, y);
      // by symmetry: to the left corner's disc, over its top, along the wall's thickness, down again
      const Eigen::Vector2d to = start - Eigen::Vector2d(9.95, 5.0);
      const double half = roundADisc(to, Eigen::Vector2d(0.0, kRadius + 1e-12), kRadius);
      expectWithin(world, start, goal, 2.0 * half + 0.1);
    }
  }
}

TEST(ShortestPathTest, aroundABoxOfAnyCellSize) {
  for (const double resolution : {0.02, 0.05, 0.1, 0.25, 1.0}) {
    const World world = drawnWorld(12, 12, resolution, [](double x, double y) { return x > 4 && x < 8 && y > 3 && y < 9; });
    const Eigen::Vector2d start(2, 6), goal(10, 6);
    const double half = roundADisc(start - Eigen::Vector2d(4, 9), Eigen::Vector2d(0.0, kRadius + 1e-12), kRadius);
    const auto length = shortestLength(world, start, goal, kRadius);
    ASSERT_TRUE(length.has_value()) << resolution;
    EXPECT_LE(*length, 1.02 * (2.0 * half + 4.0)) << resolution;
    EXPECT_GE(*length, 0.998 * (2.0 * half + 4.0)) << resolution;
  }
}

TEST(ShortestPathTest, theShorterOfTwoWaysAtAnOddAngle) {
  // The box is turned against the grid, so that its sides are stairs: long ways at angles that grids are bad at
  const double angle = 0.4;
  const Eigen::Vector2d middle(10, 10), along(std::cos(angle), std::sin(angle)), across(-along.y(), along.x());
  const World world = drawnWorld(20, 20, 0.05, [&](double x, double y) {
    const Eigen::Vector2d p = Eigen::Vector2d(x, y) - middle;
    return std::abs(p.dot(along)) < 4.0 && p.dot(across) > -1.0 && p.dot(across) < 0.5;
  });
  const Eigen::Vector2d start = middle + 6.0 * along, goal = middle - 6.0 * along;
  const double side = roundADisc(start - (middle + 4.0 * along + 0.5 * across), across * (kRadius + 1e-12), kRadius);
  expectWithin(world, start, goal, 2.0 * side + 8.0);
}

TEST(ShortestPathTest, passagesAsWideAsTheDiscAreOpenAndNarrowerOnesAreNot) {
  for (const int cells : {9, 10, 11, 12}) {
    const double gap = 0.05 * cells;
    const World world =
        drawnWorld(8, 4, 0.05, [gap](double x, double y) { return std::abs(x - 4.0) < 0.5 && (y < 2.0 || y > 2.0 + gap); });
    const auto length = shortestLength(world, {1, 2}, {7, 2}, kRadius);
    EXPECT_EQ(length.has_value(), cells >= 10) << cells;
    if (length) {
      EXPECT_LT(*length, 6.2);
    }
  }
}

TEST(ShortestPathTest, noneIntoAWallOrOutOfARoom) {
  const World world = drawnWorld(10, 10, 0.05, [](double x, double y) {
    const double r = std::max(std::abs(x - 5.0), std::abs(y - 5.0));
    return r > 2.0 && r < 2.2;
  });
  EXPECT_FALSE(shortestLength(world, {5, 5}, {1, 1}, kRadius).has_value());
  EXPECT_FALSE(shortestLength(world, {5, 5}, {7.1, 5}, kRadius).has_value());
  EXPECT_FALSE(shortestLength(world, {5, 5}, {6.9, 5}, kRadius).has_value());  // too near to the wall
  EXPECT_FALSE(shortestLength(world, {5, 5}, {50, 5}, kRadius).has_value());
  EXPECT_TRUE(shortestLength(world, {5, 5}, {6.7, 5}, kRadius).has_value());
}

}  // namespace
}  // namespace parley::sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

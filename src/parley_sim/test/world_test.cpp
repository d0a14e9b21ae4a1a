// SPDX-License-Identifier: BSD-3-Clause
#include "parley_sim/world.h"

#include <gtest/gtest.h>

#include <limits>

#include "parley_sim/random_stream.h"
#include "worlds.h"

namespace parley::sim {
namespace {

/// A third of the cells solid, without any order.
World clutter(double share) {
  RandomStream random(3, "test", "clutter");
  return drawnWorld(5.0, 4.0, 0.1, [&](double, double) { return random.uniform() < share; });
}

/// Every cell that a ray goes through, found without stepping from one to the next.
double slowRay(const World& world, const Eigen::Vector2d& origin, const Eigen::Vector2d& direction, double max_range) {
  double nearest = std::numeric_limits<double>::infinity();
  const GridFrame& frame = world.frame();
  for (int y = -1; y <= frame.height; ++y) {
    for (int x = -1; x <= frame.width; ++x) {
      if (!world.isSolid(Eigen::Vector2i(x, y))) continue;
      const Box square{frame.centerOf({x, y}), Eigen::Vector2d::UnitX(), 0.5 * frame.resolution, 0.5 * frame.resolution};
      const auto hit = crossing(square, origin, direction);
      if (hit && hit->leave > 0.0) nearest = std::min(nearest, std::max(0.0, hit->enter));
    }
  }
  return nearest <= max_range ? nearest : std::numeric_limits<double>::infinity();
}

TEST(WorldTest, outsideIsSolid) {
  const World world = emptyWorld(2.0, 1.0, 0.1);
  EXPECT_FALSE(world.isSolid(Eigen::Vector2d(1.0, 0.5)));
  EXPECT_TRUE(world.isSolid(Eigen::Vector2d(-0.01, 0.5)));
  EXPECT_TRUE(world.isSolid(Eigen::Vector2d(1.0, 1.01)));
  EXPECT_TRUE(world.isSolid(Eigen::Vector2i(100, 100)));
  EXPECT_EQ(world.castRay({-1.0, 0.5}, {1.0, 0.0}, 4.0), 0.0);
}

TEST(WorldTest, raysEndAtTheWallsOfAnEmptyRoom) {
  const World world = emptyWorld(10.0, 6.0, 0.05);
  const Eigen::Vector2d origin(3.0, 2.0);
  EXPECT_NEAR(world.castRay(origin, {1, 0}, 20.0), 7.0, 1e-9);
  EXPECT_NEAR(world.castRay(origin, {-1, 0}, 20.0), 3.0, 1e-9);
  EXPECT_NEAR(world.castRay(origin, {0, 1}, 20.0), 4.0, 1e-9);
  EXPECT_NEAR(world.castRay(origin, {0, -1}, 20.0), 2.0, 1e-9);
  EXPECT_NEAR(world.castRay(origin, Eigen::Vector2d(1, 1).normalized(), 20.0), 4.0 * std::sqrt(2.0), 1e-9);
  EXPECT_TRUE(std::isinf(world.castRay(origin, {1, 0}, 6.9)));
}

TEST(WorldTest, raysAgreeWithTestingEveryCell) {
  for (const double share : {0.005, 0.05, 0.3}) {
    const World world = clutter(share);
    RandomStream random(4, "test", "rays");
    for (int round = 0; round < 400; ++round) {
      const Eigen::Vector2d origin(random.uniform(0, 5), random.uniform(0, 4));
      const double angle = random.uniform(-4, 4);
      const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
      const double expected = slowRay(world, origin, direction, 3.0), range = world.castRay(origin, direction, 3.0);
      if (std::isinf(expected) || std::isinf(range)) {
        EXPECT_EQ(std::isinf(expected), std::isinf(range)) << "share " << share << " round " << round;
      } else {
        EXPECT_NEAR(range, expected, 1e-9) << "share " << share << " round " << round;
      }
    }
  }
}

TEST(WorldTest, distancesAgreeWithTestingEveryCell) {
  const World world = clutter(0.01);
  RandomStream random(5, "test", "distances");
  for (int round = 0; round < 300; ++round) {
    const Box box = boxAt({random.uniform(0.2, 4.8), random.uniform(0.2, 3.8), random.uniform(-4, 4)}, 0.5, 0.3);
    double nearest = 1.5;
    bool touches = false;
    for (int y = -1; y <= world.frame().height; ++y) {
      for (int x = -1; x <= world.frame().width; ++x) {
        if (!world.isSolid(Eigen::Vector2i(x, y))) continue;
        const Box square{world.frame().centerOf({x, y}), Eigen::Vector2d::UnitX(), 0.05, 0.05};
        nearest = std::min(nearest, distance(box, square));
        touches = touches || overlap(box, square);
      }
    }
    EXPECT_NEAR(world.distanceToSolid(box, 1.5), nearest, 1e-12) << "round " << round;
    const Box point{box.center, Eigen::Vector2d::UnitX(), 0.0, 0.0};
    EXPECT_NEAR(world.distanceToSolid(box.center, 0.7), world.distanceToSolid(point, 0.7), 1e-12) << "round " << round;
    EXPECT_EQ(world.overlapsSolid(box), touches) << "round " << round;
    EXPECT_LE(world.freeRadius(box.center), world.distanceToSolid(box.center, 10.0) + 1e-9);
  }
}

TEST(WorldTest, wallsBlockSight) {
  const World world = drawnWorld(4.0, 4.0, 0.1, [](double x, double y) { return std::abs(x - 2.0) < 0.1 && y < 3.0; });
  EXPECT_FALSE(world.inSight({1, 1}, {3, 1}));
  EXPECT_TRUE(world.inSight({1, 3.5}, {3, 3.5}));
  EXPECT_TRUE(world.inSight({1, 1}, {1, 1}));
}

}  // namespace
}  // namespace parley::sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

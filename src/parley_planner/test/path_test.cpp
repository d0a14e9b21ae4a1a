// SPDX-License-Identifier: BSD-3-Clause
// The path from search to smoothing: path_search, reference_path, banded_system, local_goal.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

#include "banded_system.h"
#include "local_goal.h"
#include "parley_geometry/polygon.h"
#include "path_search.h"
#include "reference_path.h"
#include "scenes.h"

namespace parley {
namespace {

/// Two rooms joined by a door in the wall at x = 5.
LocalMap rooms(double door_y, double door_width) {
  World world(10, 10, false);
  world.fill(4.9, 0, 5.1, 10, true);
  world.fill(4.9, door_y - 0.5 * door_width, 5.1, door_y + 0.5 * door_width, false);
  return seenMap(world);
}

double leastDistance(const Surroundings& surroundings, const Path& path) {
  double least = 1e9;
  for (const Eigen::Vector2d& p : resampled(path, 0.02)) least = std::min(least, surroundings.obstacles().at(p));
  return least;
}

TEST(PathSearch, GoesThroughTheDoor) {
  const Surroundings surroundings(rooms(7.0, 0.9), {}, {}, {});
  const FoundPath found = searchPath(surroundings, {2.0, 2.0}, {8.0, 2.0}, {}, {});
  ASSERT_TRUE(found.reaches);
  EXPECT_EQ(found.points.front(), Eigen::Vector2d(2.0, 2.0));
  EXPECT_EQ(found.points.back(), Eigen::Vector2d(8.0, 2.0));
  EXPECT_GT(leastDistance(surroundings, found.points), 0.2);
  const Path straight = straightened(surroundings, found.points, 0.4);
  EXPECT_LT(straight.size(), 12U);
  EXPECT_LT(pathLength(straight), pathLength(found.points) + 1e-9);
  EXPECT_GT(leastDistance(surroundings, straight), 0.2);
}

TEST(PathSearch, PassesGapsNarrowerThanItsLattice) {
  for (const double y : {3.0, 3.05, 3.1}) {
    const FoundPath found = searchPath(Surroundings(rooms(y, 0.55), {}, {}, {}), {2.0, 2.0}, {8.0, 2.0}, {}, {});
    EXPECT_TRUE(found.reaches) << y;
  }
  EXPECT_FALSE(searchPath(Surroundings(rooms(3.0, 0.35), {}, {}, {}), {2.0, 2.0}, {8.0, 2.0}, {}, {}).reaches);
}

TEST(PathSearch, ComesNearWhereTheGoalIsClosedOff) {
  const Surroundings surroundings(rooms(7.0, 0.0), {}, {}, {});
  const FoundPath found = searchPath(surroundings, {2.0, 5.0}, {8.0, 5.0}, {}, {});
  EXPECT_FALSE(found.reaches);
  ASSERT_FALSE(found.points.empty());
  EXPECT_GT(found.points.back().x(), 4.0);
  EXPECT_TRUE(searchPath(surroundings, {4.6, 5.0}, {8.0, 5.0}, {}, {}).points.empty());
}

TEST(PathSearch, GoesAsFarAsTheRouteIsOpen) {
  // The goal is behind the wall; the route leads round by a door at the top that has been shut.
  const Surroundings surroundings(rooms(9.0, 0.0), {}, {}, {});
  const Path route = resampled({{4.0, 2.0}, {4.0, 9.0}, {6.0, 9.0}, {6.0, 2.0}}, 0.1);
  const FoundPath found = searchPath(surroundings, {4.0, 2.0}, {6.0, 2.0}, {}, {}, route);
  EXPECT_FALSE(found.reaches);
  ASSERT_FALSE(found.points.empty());
  EXPECT_NEAR(found.points.back().x(), 4.65, 0.15);
  EXPECT_NEAR(found.points.back().y(), 9.0, 0.1);
  EXPECT_NEAR(searchPath(surroundings, {4.0, 2.0}, {6.0, 2.0}, {}, {}).points.back().y(), 2.0, 0.2) << "as the crow flies";
  EXPECT_TRUE(searchPath(surroundings, {4.6, 9.0}, {6.0, 9.0}, {}, {}, resampled({{4.6, 9.0}, {6.0, 9.0}}, 0.1)).points.empty());
}

TEST(PathSearch, KeepsTheSideItHasChosen) {
  World world(10, 10, false);
  world.fill(4.5, 3.9, 5.5, 6.0, true);  // a little shorter to pass above than below
  const Surroundings surroundings(seenMap(world), {}, {}, {});
  const FoundPath fresh = searchPath(surroundings, {2.0, 5.0}, {8.0, 5.0}, {}, {});
  const auto above = [](const Path& path) {
    return std::any_of(path.begin(), path.end(), [](const Eigen::Vector2d& p) { return p.y() > 6.0; });
  };
  ASSERT_TRUE(above(fresh.points));
  const Path below = resampled({{2.0, 5.0}, {4.4, 3.4}, {5.6, 3.4}, {8.0, 5.0}}, 0.1);
  EXPECT_FALSE(above(searchPath(surroundings, {2.0, 5.0}, {8.0, 5.0}, below, {}).points));
}

TEST(PathSearch, SeenSpaceIsCheaper) {
  LocalMap map = seenMap(World(10, 10, false));
  setCells(&map, 4.0, 4.5, 6.0, 10.0, CellState::kUnknown);
  PathSearchOptions options;
  options.unknown_cost = 5.0;
  const FoundPath found = searchPath(Surroundings(map, {}, {}, {}), {3.0, 5.0}, {7.0, 5.0}, {}, options);
  ASSERT_TRUE(found.reaches);
  EXPECT_TRUE(std::any_of(found.points.begin(), found.points.end(), [](const auto& p) { return p.y() < 4.5; }));
}

TEST(Resampled, KeepsEndsAndSpacing) {
  const Path path = resampled({{0.0, 0.0}, {1.0, 0.0}, {1.0, 0.0}, {1.0, 2.0}}, 0.07);
  EXPECT_EQ(path.front(), Eigen::Vector2d(0.0, 0.0));
  EXPECT_EQ(path.back(), Eigen::Vector2d(1.0, 2.0));
  for (std::size_t i = 1; i < path.size(); ++i) EXPECT_LE((path[i] - path[i - 1]).norm(), 0.0701);
  EXPECT_NEAR(pathLength(path), 3.0, 0.05);
}

TEST(BandedSystem, SolvesLikeADenseOne) {
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  for (int n : {1, 3, 20}) {
    BandedSystem<3> system(static_cast<std::size_t>(n));
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);
    Eigen::VectorXd right(n);
    for (int i = 0; i < n; ++i) {
      for (int j = i; j < std::min(n, i + 4); ++j) {
        const double value = i == j ? 8.0 : normal(random);
        system.add(static_cast<std::size_t>(i), static_cast<std::size_t>(j), value);
        dense(i, j) = dense(j, i) = value;
      }
      right(i) = normal(random);
      system.addRight(static_cast<std::size_t>(i), right(i));
    }
    const Eigen::VectorXd expected = dense.ldlt().solve(right);
    const std::vector<double> found = std::move(system).solve();
    for (int i = 0; i < n; ++i) EXPECT_NEAR(found[static_cast<std::size_t>(i)], expected(i), 1e-9);
  }
}

TEST(ReferencePath, KnowsArcs) {
  Path points;
  for (int i = 0; i <= 40; ++i) points.push_back(integrateTwist({1.0, 2.0, 0.5}, 1.0, 0.8, 0.1 * i).position());
  const ReferencePath path(points);
  EXPECT_NEAR(path.length(), 4.0, 0.01);
  EXPECT_NEAR(path.at(2.0).curvature, 0.8, 0.01);
  EXPECT_NEAR(angleBetween(path.at(2.0).yaw, 0.5 + 0.8 * 2.0), 0.0, 0.01);
  EXPECT_EQ(path.at(-1.0).position, points.front());
  EXPECT_EQ(path.at(99.0).position, points.back());
  EXPECT_NEAR(path.project(path.at(1.5).position + Eigen::Vector2d(0.01, 0.0), 1.3, 0.5), 1.5, 0.02);
}

TEST(Smoothed, StartsInTheMotionThatIsDriven) {
  const Surroundings surroundings(seenMap(World(10, 10, false)), {}, {}, {});
  const PathStart start{{3.0, 3.0, 0.2}, 1.8, 0.9};
  const ReferencePath path = smoothed({{3.0, 3.0}, {7.0, 5.0}}, start, surroundings.obstacles(), {});
  const double s = path.project({3.0, 3.0}, 0.0, 0.5);
  EXPECT_NEAR((path.at(s).position - Eigen::Vector2d(3.0, 3.0)).norm(), 0.0, 1e-3);
  EXPECT_NEAR(path.at(s).yaw, 0.2, 0.02);
  EXPECT_NEAR(path.at(s).curvature, 0.5, 0.15);
  EXPECT_NEAR((path.points().back() - Eigen::Vector2d(7.0, 5.0)).norm(), 0.0, 1e-9);
}

TEST(Smoothed, RoundsCornersWideAndKeepsClear) {
  World world(10, 10, true);
  world.fill(0, 4.4, 6, 5.6, false);
  world.fill(4.8, 0, 6, 5.6, false);
  const Surroundings surroundings(seenMap(world), {}, {}, {});
  const Path corner = {{2.0, 5.0}, {5.4, 5.0}, {5.4, 1.5}};
  const ReferencePath path = smoothed(corner, {{2.0, 5.0, 0.0}, 1.5, 0.0}, surroundings.obstacles(), {});
  double tightest = 0.0;
  for (const double s : path.arcLengths()) tightest = std::max(tightest, std::abs(path.at(s).curvature));
  EXPECT_LT(tightest, 1.2);  // 1.3 m/s at pi/2 rad/s
  EXPECT_GT(leastDistance(surroundings, path.points()), 0.25);
}

TEST(LocalGoal, LiesAheadOnTheRouteInsideTheWindow) {
  Route route;
  route.points = {{0.0, 5.0}, {6.0, 5.0}, {6.0, 30.0}};
  const GridFrame window{{0.0, 0.0}, 0.05, 200, 200};
  EXPECT_NEAR((localGoal(route, {1.0, 5.3}, 3.0, window, 0.4) - Eigen::Vector2d(4.0, 5.0)).norm(), 0.0, 0.11);
  EXPECT_NEAR((localGoal(route, {5.0, 5.0}, 3.0, window, 0.4) - Eigen::Vector2d(6.0, 7.0)).norm(), 0.0, 0.15);
  EXPECT_LE(localGoal(route, {6.0, 8.0}, 9.0, window, 0.4).y(), 9.6);
  route.points = {{1.0, 5.0}, {2.0, 5.0}};
  EXPECT_NEAR((localGoal(route, {1.0, 5.0}, 9.0, window, 0.4) - Eigen::Vector2d(2.0, 5.0)).norm(), 0.0, 1e-9);
}

}  // namespace
}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

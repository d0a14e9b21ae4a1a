// SPDX-License-Identifier: BSD-3-Clause
#include "parley_topology/topology.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "parley_geometry/polygon.h"
#include "test_world.h"

namespace parley {
namespace {

/// Scans from every free place on a grid, until all is known.
void explore(Topology& topology, const TestWorld& world, double spacing = 1.0) {
  for (int pass = 0; pass < 3; ++pass) {
    for (double y = 0.5 * spacing; y < world.height(); y += spacing) {
      for (double x = 0.5 * spacing; x < world.width(); x += spacing) {
        if (!world.isClear({x, y}, 0.25)) continue;
        topology.integrate(world.scan({x, y, 0.1}), {x, y, 0.1});
      }
    }
  }
  topology.update();
}

Pose2 at(double x, double y) { return {x, y, 0.0}; }

/// A robot small enough to follow routes to the letter.
Footprint discLike() { return {0.4, 0.4}; }

}  // namespace

TEST(Topology, goesStraightThroughTheUnknown) {
  Topology topology({}, testFootprint());
  topology.update();
  const Route route = topology.route(at(0, 0), {30, 40});
  EXPECT_EQ(route.verdict, RouteVerdict::kThroughUnknown);
  ASSERT_EQ(route.points.size(), 2U);
  EXPECT_NEAR(route.length, 50.0, 1e-9);
  EXPECT_NEAR(route.cost, 50.0 * TopologyOptions().unknown_cost, 0.2);
}

TEST(Topology, goesAroundAColumnByTheShorterSide) {
  TestWorld world(8.0, 8.0);
  world.setBox(3.5, 3.2, 4.5, 4.6);
  Topology topology({}, testFootprint());
  explore(topology, world);
  const Route route = topology.route(at(2.0, 3.8), {6.0, 3.8});
  EXPECT_EQ(route.verdict, RouteVerdict::kThroughKnown);
  ASSERT_EQ(route.points.size(), 4U);
  EXPECT_LT(route.points[1].y(), 3.2);  // 0.6 m below, 0.8 m above
  EXPECT_NEAR(route.length, world.shortestWay({2.0, 3.8}, {6.0, 3.8}, 0.22), 0.15);
  EXPECT_EQ(route.switches, 0);
}

TEST(Topology, corridorHasItsWidth) {
  const TestWorld world = TestWorld::fromText({"############", "#..........#", "############"}, 1.2);
  Topology topology({}, testFootprint());
  explore(topology, world, 0.6);
  const Route route = topology.route(at(2.0, 1.8), {12.0, 1.8});
  EXPECT_EQ(route.verdict, RouteVerdict::kThroughKnown);
  EXPECT_NEAR(route.length, 10.0, 0.01);
  EXPECT_NEAR(route.narrowest, 1.2, 0.11);
}

TEST(Topology, crossOfCorridors) {
  const TestWorld world = TestWorld::fromText(
      {"#####.#####", "#####.#####", "#####.#####", "#####.#####", "...........", "#####.#####", "#####.#####", "#####.#####"},
      1.0);
  Topology topology({}, testFootprint());
  explore(topology, world, 0.5);
  const Route route = topology.route(at(0.5, 3.5), {5.5, 0.5});
  EXPECT_EQ(route.verdict, RouteVerdict::kThroughKnown);
  EXPECT_NEAR(route.length, world.shortestWay({0.5, 3.5}, {5.5, 0.5}, 0.22), 0.2);
}

TEST(Topology, doorwaysFromTheSizeOfTheRobotOn) {
  for (double gap : {0.3, 0.4, 0.55, 0.6, 0.8}) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
      std::mt19937 random(seed);
      TestWorld world(8.0, 6.0, 0.01);
      const double y = 2.5 + 0.1 * seed + 0.013 * seed;
      world.setBox(4.0 + 0.011 * seed, 0.0, 4.2, y);
      world.setBox(4.0 + 0.011 * seed, y + gap, 4.2, 6.0);
      Topology topology({}, testFootprint());
      for (int i = 0; i < 40; ++i) {
        const Pose2 pose = at(2.0 + 0.035 * i, 3.0 + 0.5 * std::sin(0.4 * i));
        topology.integrate(world.noisyScan(pose, 0.02, random), pose);
        topology.update();
      }
      EXPECT_EQ(topology.route(at(3.4, 3.0), {6.0, 3.0}).exists(), gap > 0.5) << "gap " << gap << " seed " << seed;
    }
  }
}

/// A wall with a gap of 0.6 m in the straight way and, if there is one, a door far off.
class Passage : public testing::Test {
 protected:
  explicit Passage(bool door = true) : world_(10.0, 10.0) {
    world_.setBox(4.9, 0.0, 5.1, 2.0);
    world_.setBox(4.9, 2.6, 5.1, 10.0);
    if (door) world_.setBox(4.9, 8.0, 5.1, 9.5, false);
    explore(topology_, world_);
  }
  /// Whether the way leads through the gap.
  bool usesGap() {
    const Route route = topology_.route(at(2.0, 2.3), {8.0, 2.3});
    return route.exists() && route.length < 7.0;
  }
  TestWorld world_;
  Topology topology_{{}, testFootprint()};
};

TEST_F(Passage, thatIsTooNarrowIsAvoidedUntilItIsWider) {
  ASSERT_TRUE(usesGap());
  const std::size_t told = topology_.contours().size();
  EXPECT_TRUE(topology_.shutPassage({5.0, 2.3}));
  topology_.update();
  EXPECT_FALSE(usesGap());
  EXPECT_TRUE(topology_.route(at(2.0, 2.3), {8.0, 2.3}).exists()) << "through the door";
  EXPECT_EQ(topology_.contours().size(), told) << "others are not told of walls that are none";
  for (int i = 0; i < 20; ++i) topology_.integrate(world_.scan(at(3.5, 2.3)), at(3.5, 2.3));
  topology_.update();
  EXPECT_FALSE(usesGap()) << "seeing through it does not open it";
  world_.setBox(4.9, 0.5, 5.1, 2.0, false);
  for (int i = 0; i < 20; ++i) topology_.integrate(world_.scan(at(3.5, 2.3)), at(3.5, 2.3));
  topology_.update();
  EXPECT_TRUE(usesGap());
}

TEST_F(Passage, whereNothingStandsIsNotShut) {
  EXPECT_FALSE(topology_.shutPassage({2.0, 5.0}));
  EXPECT_FALSE(topology_.shutPassage({std::nan(""), 5.0}));
  EXPECT_FALSE(topology_.shutPassage({1e6, 5.0}));
  EXPECT_TRUE(topology_.shutPassage({5.0, 2.3}));
  EXPECT_FALSE(topology_.shutPassage({5.0, 2.3})) << "it is shut";
  topology_.reset();
  explore(topology_, world_);
  EXPECT_TRUE(usesGap());
}

class OnlyPassage : public Passage {
 protected:
  OnlyPassage() : Passage(false) {}
};

TEST_F(OnlyPassage, isTriedAgain) {
  ASSERT_TRUE(usesGap());
  ASSERT_TRUE(topology_.shutPassage({5.0, 2.3}));
  topology_.update();
  EXPECT_FALSE(usesGap());
  topology_.update();
  EXPECT_TRUE(usesGap());
}

TEST(Topology, sealedOffIsUnreachable) {
  TestWorld world(12.0, 12.0);
  world.setBox(4.0, 4.0, 8.0, 8.0);
  world.setBox(4.2, 4.2, 7.8, 7.8, false);
  Topology topology({}, testFootprint());
  explore(topology, world);
  const Route route = topology.route(at(1.0, 1.0), {6.0, 6.0});
  EXPECT_EQ(route.verdict, RouteVerdict::kUnreachableAsKnown);
  EXPECT_FALSE(route.exists());
  EXPECT_TRUE(topology.route(at(1.0, 1.0), {11.0, 11.0}).exists());
  TopologyOptions options;
  options.search = "depth_first";
  Topology other(options, testFootprint());
  explore(other, world);
  EXPECT_EQ(other.route(at(1.0, 1.0), {6.0, 6.0}).verdict, RouteVerdict::kUnreachableAsKnown);
  EXPECT_NEAR(other.route(at(1.0, 1.0), {11.0, 11.0}).cost, topology.route(at(1.0, 1.0), {11.0, 11.0}).cost, 1e-9);
}

TEST(Topology, startsAndGoalsTooCloseToWallsAreMoved) {
  TestWorld world(8.0, 8.0);
  Topology topology({}, testFootprint());
  explore(topology, world);
  const Route from_wall = topology.route(at(0.1, 4.0), {4.0, 4.0});
  ASSERT_TRUE(from_wall.exists());
  EXPECT_EQ(from_wall.points.front(), Eigen::Vector2d(0.1, 4.0));
  const Route to_wall = topology.route(at(4.0, 4.0), {0.1, 4.0});
  ASSERT_TRUE(to_wall.exists());
  EXPECT_LT((to_wall.points.back() - Eigen::Vector2d(0.1, 4.0)).norm(), 0.3);
  world.setBox(5.0, 5.0, 6.5, 6.5);
  explore(topology, world);
  EXPECT_EQ(topology.route(at(4.0, 4.0), {5.75, 5.75}).verdict, RouteVerdict::kUnreachableAsKnown);
}

TEST(Topology, routesAreAsShortAsAGridsOnceAllIsSeen) {
  std::mt19937 random(9);
  int compared = 0;
  for (unsigned seed = 1; seed <= 6; ++seed) {
    const TestWorld world = seed % 2 ? TestWorld::rooms(15.0, 5.0, seed) : TestWorld::boxes(15.0, 20, seed);
    std::uniform_real_distribution<double> place(0.5, 14.5);
    TopologyOptions options;
    options.narrow_cost = 0.0;
    options.unknown_cost = 1.0;
    Topology topology(options, testFootprint());
    explore(topology, world, 0.7);
    for (int k = 0; k < 12; ++k) {
      const Eigen::Vector2d from(place(random), place(random)), to(place(random), place(random));
      if (!world.isClear(from, 0.3) || !world.isClear(to, 0.3) || (to - from).norm() < 2.0) continue;
      const double wide = world.shortestWay(from, to, 0.25), tight = world.shortestWay(from, to, 0.16);
      const Route route = topology.route({from.x(), from.y(), 0.0}, to);
      if (std::isinf(wide) || wide > 1.05 * tight) continue;  // passages in which a centimetre decides
      ASSERT_TRUE(route.exists()) << "seed " << seed << " from " << from.transpose() << " to " << to.transpose();
      EXPECT_LT(route.length, 1.05 * wide) << "seed " << seed << " from " << from.transpose() << " to " << to.transpose();
      EXPECT_GT(route.length, 0.95 * tight);
      ++compared;
    }
  }
  EXPECT_GT(compared, 25);
}

TEST(Topology, leavesATrapOnceAndDoesNotComeBack) {
  const TestWorld world = TestWorld::fromText(
      {"........................", "........................", "......##############....", "...................#....",
       "...................#....", "...................#....", "...................#....", "...................#....",
       "......##############....", "........................", "........................"},
      1.0);
  Topology topology({}, discLike());
  int entries = 0;
  bool inside = false;
  DriveOptions options;
  options.noise = 0.02;
  options.after = [&](int, const TopologyResult&, const Route& route) {
    const bool now_inside =
        route.points.front().x() > 12.0 && route.points.front().x() < 19.0 && std::abs(route.points.front().y() - 5.5) < 2.5;
    entries += now_inside && !inside ? 1 : 0;
    inside = now_inside;
  };
  const Drive result = drive(topology, world, {2.0, 5.5}, {22.5, 5.5}, options);
  EXPECT_TRUE(result.arrived);
  EXPECT_FALSE(result.hit);
  EXPECT_LE(entries, 1);
  EXPECT_LE(result.switches, 4);
  EXPECT_LT(result.length, 65.0);  // in, out again and around
}

TEST(Topology, arrivesInWorldsNobodyTunedFor) {
  for (unsigned seed = 11; seed <= 16; ++seed) {
    const TestWorld world = seed % 2 ? TestWorld::rooms(20.0, 5.0, seed) : TestWorld::boxes(20.0, 30, seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(0.5, 19.5);
    Eigen::Vector2d from, to;
    double shortest = 0.0;
    do {
      from = {place(random), place(random)};
      to = {place(random), place(random)};
      const bool clear = world.isClear(from, 0.35) && world.isClear(to, 0.35) && (to - from).norm() > 10.0;
      shortest = clear ? world.shortestWay(from, to, 0.3) : std::numeric_limits<double>::infinity();
    } while (std::isinf(shortest));
    Topology topology({}, discLike());
    DriveOptions options;
    options.noise = 0.02;
    options.seed = seed;
    const Drive result = drive(topology, world, from, to, options);
    EXPECT_TRUE(result.arrived) << "seed " << seed;
    EXPECT_FALSE(result.hit) << "seed " << seed;
    EXPECT_LT(result.length, 3.0 * shortest) << "seed " << seed;
  }
}

TEST(Topology, ownSensingOverrulesAPeer) {
  TestWorld world(10.0, 6.0);
  Topology topology({}, testFootprint());
  LayerUpdate layer{"bob", 1, 5.0, {}, true, {}};
  layer.contours.push_back({{{6.0, -1.0}, {6.0, 7.0}}, false});  // a wall that is not there
  topology.setLayer(layer);
  topology.integrate(world.scan(at(1.0, 3.0)), at(1.0, 3.0));
  topology.update();
  const Route told = topology.route(at(1.0, 3.0), {9.0, 3.0});
  EXPECT_GT(told.length, 9.0);
  bool from_bob = false;
  for (const Vertex& v : topology.graph().vertices()) from_bob = from_bob || v.provenance.origin == "bob";
  EXPECT_TRUE(from_bob);
  EXPECT_EQ(topology.localMap({6.0, 3.0}, 1.0, 0.0).at(Eigen::Vector2d(6.01, 3.0)), CellState::kOccupied);
  for (int i = 0; i < 10; ++i) topology.integrate(world.scan(at(4.0, 3.0)), at(4.0, 3.0));
  topology.update();
  const Route seen = topology.route(at(4.0, 3.0), {9.0, 3.0});
  EXPECT_NEAR(seen.length, 5.0, 0.01);
  EXPECT_EQ(topology.localMap({6.0, 3.0}, 1.0, 0.0).at(Eigen::Vector2d(6.01, 3.0)), CellState::kSeenFree);
}

TEST(Topology, tentativePeersMakeWaysDearerOnly) {
  Topology topology({}, testFootprint());
  LayerUpdate layer{"bob", 1, 5.0, {}, false, {}};
  layer.contours.push_back({{{5.0, -100.0}, {5.0, 100.0}}, false});
  topology.update();
  const double before = topology.route(at(0.0, 0.0), {10.0, 0.0}).cost;
  topology.setLayer(layer);
  EXPECT_EQ(topology.update().layers, 1);
  const Route route = topology.route(at(0.0, 0.0), {10.0, 0.0});
  ASSERT_TRUE(route.exists());
  EXPECT_NEAR(route.length, 10.0, 1e-9);
  EXPECT_GT(route.cost, before + 1.0);
  EXPECT_TRUE(topology.graph().vertices().empty());
}

TEST(Topology, tellsItsOutlinesByTile) {
  TestWorld world(10.0, 10.0);
  world.setBox(4.0, 4.0, 6.0, 6.0);
  Topology topology({}, testFootprint());
  explore(topology, world);
  LayerUpdate layer{"bob", 1, 5.0, {}, true, {}};
  layer.contours.push_back({{{20.0, 20.0}, {22.0, 20.0}}, false});
  topology.setLayer(layer);
  topology.update();
  const std::vector<Contour> own = topology.contours(), fused = topology.fusedContours();
  ASSERT_FALSE(own.empty());
  EXPECT_GT(fused.size(), own.size());
  for (const Contour& contour : own) {
    for (const Eigen::Vector2d& p : contour.polygon) {
      const bool on_box = p.x() > 3.9 && p.x() < 6.1 && p.y() > 3.9 && p.y() < 6.1;
      const bool on_wall = std::min({p.x(), p.y(), 10.0 - p.x(), 10.0 - p.y()}) < 0.1;
      EXPECT_TRUE(on_box || on_wall) << p.transpose();
    }
  }
}

TEST(Topology, tellsThinWallsAsLines) {
  TestWorld world(10.0, 10.0);
  world.setBox(4.0, 5.0, 6.0, 5.05);
  world.setBox(3.0, 3.0, 3.05, 3.05);
  Topology topology({}, testFootprint());
  explore(topology, world);
  int lines = 0;
  for (const Contour& contour : topology.contours()) {
    ASSERT_GE(contour.polygon.size(), contour.closed ? 3U : 2U);
    lines += contour.closed ? 0 : 1;
  }
  EXPECT_GT(lines, 1);
}

TEST(Topology, refusesWhatIsNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  TestWorld world(6.0, 6.0);
  Topology topology({}, testFootprint());
  topology.integrate(world.scan(at(3, 3)), {nan, 0.0, 0.0});
  topology.integrate(ObstacleScan(), at(3, 3));
  topology.integrate(world.scan(at(3, 3)), at(1e7, 0.0));
  topology.setLayer({"bob", 1, 0.0, {nan, 0.0, 0.0}, true, {}});
  EXPECT_EQ(topology.route({nan, 0, 0}, {1, 1}).verdict, RouteVerdict::kNoGoal);
  EXPECT_EQ(topology.route(at(0, 0), {nan, 1}).verdict, RouteVerdict::kNoGoal);
  const TopologyResult result = topology.update();
  EXPECT_EQ(result.refused, 6);
  EXPECT_EQ(result.tiles, 0);
  EXPECT_FALSE(result.changed);
  EXPECT_TRUE(topology.localMap({nan, 0}, 5.0, 0.0).empty());
  EXPECT_TRUE(topology.localMap({0, 0}, nan, 0.0).empty());
  EXPECT_TRUE(topology.localMap({0, 0}, 1e9, 0.0).empty());
}

TEST(Topology, staysWithinItsBounds) {
  TopologyOptions options;
  options.max_tiles = 12;
  options.max_vertices = 20;
  options.max_pairs = 64;
  const TestWorld world = TestWorld::boxes(20.0, 60, 4);
  Topology topology(options, testFootprint());
  explore(topology, world, 1.5);
  const TopologyResult result = topology.update();
  EXPECT_TRUE(result.saturated);
  EXPECT_LE(result.tiles, 12);
  EXPECT_LE(result.vertices, 20);
  EXPECT_LE(result.edges, 64);
  topology.route(at(0.5, 0.5), {19.0, 19.0});
  topology.reset();
  const TopologyResult empty = topology.update();
  EXPECT_EQ(empty.tiles, 0);
  EXPECT_EQ(empty.vertices, 0);
  EXPECT_FALSE(empty.saturated);
}

TEST(Topology, badOptionsAreRefusedWithAllProblems) {
  TopologyOptions options;
  options.resolution = 5.0;
  options.search = "random";
  options.free_below = -99;
  try {
    Topology topology(options, Footprint());
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    const std::string text = error.what();
    for (const char* part : {"resolution", "search", "evidence_limit", "length", "width"}) {
      EXPECT_NE(text.find(part), std::string::npos) << part << " not in\n" << text;
    }
  }
}

}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

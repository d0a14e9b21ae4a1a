// SPDX-License-Identifier: BSD-3-Clause
#include "sight.h"

#include <gtest/gtest.h>

#include <random>

namespace parley {
namespace {

double at(std::mt19937& random) { return std::uniform_real_distribution<double>(-3.0, 9.0)(random); }

class Place {
 public:
  void box(double x0, double y0, double x1, double y1, std::uint8_t bits = kSeen | kOwn) {
    for (int y = map.cellOf(y0 + 1e-6); y <= map.cellOf(y1 - 1e-6); ++y) {
      for (int x = map.cellOf(x0 + 1e-6); x <= map.cellOf(x1 - 1e-6); ++x) {
        Tile& tile = *map.ensure(tileOf(x), tileOf(y));
        tile.flags[offsetOf(x, y)] |= bits;
        tile.changed_cells = 0xffff;
        map.note(tile);
      }
    }
    refreshField(map, shape);
  }
  void strew(std::mt19937& random) {
    for (int k = 0; k < 12; ++k) {
      const double x = at(random), y = at(random);
      box(x, y, x + 0.3, y + 0.6);
    }
  }
  TopologyOptions options;
  FieldShape shape{0.22, 1.0, 0.1};
  TiledMap map{0.05, 100.0, 1000};
  Sight sight{map, options, shape};
};

}  // namespace

TEST(Sight, aWallBlocks) {
  Place place;
  place.box(2.0, -1.0, 2.1, 1.0);
  EXPECT_FALSE(place.sight.walk({0, 0}, {4, 0}).open);
  EXPECT_NEAR(place.map.centerOf(place.sight.walk({0, 0}, {4, 0}).blocked_at.x()), 1.87, 0.1);
  EXPECT_TRUE(place.sight.walk({0, 1.3}, {4, 1.3}).open);
  EXPECT_FALSE(place.sight.walk({0, 1.05}, {4, 1.05}).open);
  EXPECT_FALSE(place.sight.look({0, 0}, {4, 0}).has_value());
}

TEST(Sight, isTheSameBothWays) {
  Place place;
  std::mt19937 random(5);
  place.strew(random);
  for (int k = 0; k < 500; ++k) {
    const Eigen::Vector2d a(at(random), at(random)), b(at(random), at(random));
    EXPECT_EQ(place.sight.walk(a, b).open, place.sight.walk(b, a).open);
    const Edge there = place.sight.measure(a, b), back = place.sight.measure(b, a);
    EXPECT_EQ(there.cost, back.cost);
    EXPECT_EQ(there.clearance, back.clearance);
  }
}

TEST(Sight, whatIsFoundNearACellIsInTheWay) {
  Place place;
  std::mt19937 random(6);
  place.strew(random);
  int shut = 0, found = 0;
  for (int k = 0; k < 2000; ++k) {
    const Eigen::Vector2d a(at(random), at(random)), b(at(random), at(random));
    const Eigen::Vector2i anywhere(place.map.cellOf(at(random)), place.map.cellOf(at(random)));
    const Walk walk = place.sight.walk(a, b);
    if (const auto cell = place.sight.shutNear(a, b, anywhere)) {
      ++found;
      EXPECT_FALSE(walk.open);
      EXPECT_FALSE(place.map.flags(cell->x(), cell->y()) & kPassable);
    }
    if (walk.open) continue;
    ++shut;
    EXPECT_TRUE(place.sight.shutNear(a, b, walk.blocked_at));
    EXPECT_TRUE(place.sight.shutNear(b, a, walk.blocked_at));
  }
  EXPECT_GT(shut, 500);
  EXPECT_GT(found, 50);
}

TEST(Sight, clearanceIsTheWidthOfThePassage) {
  Place place;
  place.box(0.0, 1.0, 10.0, 1.2);
  place.box(0.0, -0.2, 10.0, 0.0);  // a corridor 1 m wide
  EXPECT_NEAR(place.sight.measure({1, 0.5}, {9, 0.5}).clearance, 1.05, 0.08);
  EXPECT_NEAR(place.sight.measure({1, 0.25}, {9, 0.25}).clearance, 1.05, 0.08);
  EXPECT_NEAR(place.sight.measure({1, 0.25}, {9, 0.75}).clearance, 1.05, 0.08);
  EXPECT_EQ(place.sight.measure({1, 4.5}, {9, 4.5}).clearance, place.options.clearance_cap);
  EXPECT_EQ(place.sight.measure({1, 1.45}, {9, 1.45}).clearance, place.options.clearance_cap);  // along one wall only
}

TEST(Sight, aDoorwayIsAsWideAtASlant) {
  Place place;
  place.box(2.0, -3.0, 2.1, -0.35);
  place.box(2.0, 0.35, 2.1, 3.0);
  EXPECT_NEAR(place.sight.measure({0, 0}, {4, 0}).clearance, 0.75, 0.1);
  EXPECT_NEAR(place.sight.measure({0.6, -1.2}, {3.5, 1.2}).clearance, 0.75, 0.2);
  EXPECT_GT(place.sight.measure({0, 0}, {4, 0}).narrow_length, 0.02);
  EXPECT_LT(place.sight.measure({0, 0}, {4, 0}).narrow_length, 0.3);
}

TEST(Sight, whatWasNotSeenOrIsTentativeIsDearer) {
  Place place;
  place.box(0.0, -1.0, 4.0, 1.0, kSeen);
  const Edge edge = place.sight.measure({2.0, 0.0}, {8.0, 0.0});
  EXPECT_NEAR(edge.unknown_length, 4.0, 0.11);
  EXPECT_NEAR(edge.cost, 6.0 + (place.options.unknown_cost - 1.0) * 4.0, 0.1);
  EXPECT_EQ(place.sight.measure({1, 0}, {3, 0}).cost, 2.0);
  place.map.find(0, 0)->flags[offsetOf(50, 0)] |= kTentative;
  place.map.find(0, 0)->flags[offsetOf(51, 0)] |= kTentative;
  EXPECT_NEAR(place.sight.measure({1, 0.01}, {3, 0.01}).tentative_length, 0.1, 0.01);
}

TEST(Sight, findsTheNearestClearPointOnThisSideOfAWall) {
  Place place;
  place.box(2.0, -2.0, 2.05, 2.0);
  const std::optional<Eigen::Vector2d> left = place.sight.nearestWith(kPassable, {1.95, 0.0}, 0.6);
  ASSERT_TRUE(left.has_value());
  EXPECT_LT(left->x(), 2.0);
  EXPECT_LT((*left - Eigen::Vector2d(1.95, 0.0)).norm(), 0.3);
  EXPECT_FALSE(place.sight.nearestWith(kPassable, {1.95, 0.0}, 0.05).has_value());
  EXPECT_TRUE(place.sight.nearestWith(kPassable, {2.02, 0.0}, 0.6).has_value());
  EXPECT_LT(place.sight.nearestWith(kWide, {1.95, 0.0}, 0.6)->x(), left->x());
  EXPECT_EQ(*place.sight.nearestWith(kPassable, {1.0, 0.0}, 0.0), Eigen::Vector2d(1.0, 0.0));
}

TEST(Sight, edgesAreMeasuredOnce) {
  Place place;
  VisibilityGraph graph;
  Vertex a, b;
  b.position = {3.0, 4.0};
  graph.addVertex(a);
  graph.addVertex(b);
  Edge edge;
  edge.from = 0;
  edge.to = 1;
  edge.length = 5.0;
  const int slot = graph.addEdge(edge);
  measureEdge(graph, slot, place.sight);
  EXPECT_TRUE(graph.edge(slot).measured);
  EXPECT_NEAR(graph.edge(slot).cost, 5.0 * place.options.unknown_cost, 1e-9);
  graph.edge(slot).cost = 1.0;
  measureEdge(graph, slot, place.sight);
  EXPECT_EQ(graph.edge(slot).cost, 1.0);
  graph.removeEdge(slot);
  measureEdge(graph, slot, place.sight);
  EXPECT_FALSE(graph.edge(slot).measured);
}

}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

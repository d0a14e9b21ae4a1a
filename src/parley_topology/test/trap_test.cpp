// SPDX-License-Identifier: BSD-3-Clause
// A planner with hysteresis in time instead of space, given a teammate's graph, was seen to turn round at the mouth of a
// trap for ever, because the two ways out cost nearly the same. Here the way is changed once for each piece of news.
#include <gtest/gtest.h>

#include "test_world.h"

namespace parley {
namespace {

/// A U open to the left, nearly as long around the top as around the bottom.
TestWorld uWorld() {
  return TestWorld::fromText({"............................", "............................", "............................",
                              "........##############......", ".....................#......", ".....................#......",
                              ".....................#......", ".....................#......", ".....................#......",
                              "........##############......", "............................", "............................",
                              "............................"},
                             1.0);
}

Footprint discLike() { return {0.4, 0.4}; }

const Eigen::Vector2d kStart(10.0, 6.5);
const Eigen::Vector2d kGoal(26.0, 6.5);

LayerUpdate layerOf(const TestWorld& world, const Pose2& T_peer_world, const Pose2& T_odom_peer) {
  LayerUpdate layer{"bob", 1, 0.0, T_odom_peer, true, world.outlines()};
  for (LayerContour& contour : layer.contours) contour.polygon = transformed(T_peer_world, contour.polygon);
  return layer;
}

}  // namespace

TEST(Trap, aTeammatesMapTurnsTheRobotOnce) {
  const TestWorld world = uWorld();
  const Pose2 T_peer_world{3.0, -7.0, 1.1};
  for (int told_at : {0, 10, 25, 40, 50}) {  // from before it starts to deep inside
    Topology topology({}, discLike());
    int switches_before = 0, switches_after = 0;
    DriveOptions options;
    options.noise = 0.02;
    options.each = [&](int scan, Topology& t) {
      if (scan == told_at) t.setLayer(layerOf(world, T_peer_world, T_peer_world.inverse()));
    };
    options.after = [&](int scan, const TopologyResult&, const Route& route) {
      (scan < told_at ? switches_before : switches_after) = route.switches;
    };
    const Drive result = drive(topology, world, kStart, kGoal, options);
    EXPECT_TRUE(result.arrived) << told_at;
    EXPECT_FALSE(result.hit) << told_at;
    EXPECT_LE(switches_after - switches_before, 1) << told_at;
    const double driven_in = 0.2 * told_at;
    EXPECT_LT(result.length, 1.05 * (2.0 * driven_in + world.shortestWay(kStart, kGoal, 0.22))) << told_at;
  }
}

TEST(Trap, aPoseThatTremblesDoesNotTurnItBack) {
  const TestWorld world = uWorld();
  std::mt19937 random(8);
  std::normal_distribution<double> shift(0.0, 0.05), turn(0.0, 0.003);
  Topology topology({}, discLike());
  DriveOptions options;
  options.noise = 0.02;
  options.each = [&](int scan, Topology& t) {
    if (scan >= 20 && scan % 5 == 0) t.setLayer(layerOf(world, {}, {shift(random), shift(random), turn(random)}));
  };
  const Drive result = drive(topology, world, kStart, kGoal, options);
  EXPECT_TRUE(result.arrived);
  EXPECT_FALSE(result.hit);
  EXPECT_LE(result.switches, 1);
  EXPECT_LT(result.length, 1.1 * (8.0 + world.shortestWay(kStart, kGoal, 0.22)));
}

TEST(Trap, aLayerThatComesAndGoesTurnsItAtMostOnceEachTime) {
  const TestWorld world = uWorld();
  Topology topology({}, discLike());
  int changes = 0;
  DriveOptions options;
  options.noise = 0.02;
  options.each = [&](int scan, Topology& t) {
    if (scan % 30 != 10 || scan > 200) return;
    if (++changes % 2) t.setLayer(layerOf(world, {}, {}));
    if (changes % 2 == 0) t.removeLayer("bob");
  };
  const Drive result = drive(topology, world, kStart, kGoal, options);
  EXPECT_TRUE(result.arrived);
  EXPECT_FALSE(result.hit);
  EXPECT_LE(result.switches, changes + 2);
}

TEST(Trap, withoutATeammateItComesOutByItself) {
  const TestWorld world = uWorld();
  Topology topology({}, discLike());
  DriveOptions options;
  options.noise = 0.02;
  const Drive result = drive(topology, world, kStart, kGoal, options);
  EXPECT_TRUE(result.arrived);
  EXPECT_FALSE(result.hit);
  EXPECT_LE(result.switches, 4);
  EXPECT_LT(result.length, 75.0);
}

TEST(Trap, aDoorThatAPeerSawShutIsTriedOnlyByThoseWhoSeeIt) {
  const TestWorld open = TestWorld::fromText(
      {"####################", "#........#.........#", "#........#.........#", "#..................#", "#........#.........#",
       "#........#.........#", "#........#.........#", "#........#.........#", "#........#.........#", "#........#.........#",
       "#........#.........#", "#..................#", "####################"},
      1.0);
  TestWorld shut = open;
  shut.setBox(9.0, 9.0, 10.0, 10.0);
  // Told that the near door is shut it makes for the far one; on its way past it sees that it is open.
  Topology topology({}, discLike());
  topology.setLayer(layerOf(shut, {}, {}));
  topology.update();
  EXPECT_GT(topology.route({3.0, 9.5, 0.0}, {16.0, 9.5}).length, 17.0);
  DriveOptions options;
  options.noise = 0.02;
  const Drive passing = drive(topology, open, {8.0, 10.5}, {16.0, 9.5}, options);
  EXPECT_TRUE(passing.arrived);
  EXPECT_FALSE(passing.hit);
  EXPECT_LT(passing.length, 11.0);
  EXPECT_LE(passing.switches, 1);
}

}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

// SPDX-License-Identifier: BSD-3-Clause
// What changes while nobody looks: doors that others saw shut or open after own sensing had looked.
#include <gtest/gtest.h>

#include <algorithm>

#include "test_world.h"

namespace parley {
namespace {

constexpr double kDoorAt = 6.0;  // [m] x of the wall; its door is from y = 2.4 to 3.6

/// Two rooms of 6 by 6 m with a door of 1.2 m between them.
TestWorld twoRooms(bool open) {
  TestWorld world(12.0, 6.0);
  world.setBox(kDoorAt - 0.1, 0.0, kDoorAt + 0.1, 6.0);
  if (open) world.setBox(kDoorAt - 0.1, 2.4, kDoorAt + 0.1, 3.6, false);
  return world;
}

void look(Topology& topology, const TestWorld& world, const Pose2& pose, double stamp) {
  for (int i = 0; i < 10; ++i) {
    ObstacleScan scan = world.scan(pose, 8.0);
    scan.stamp = stamp;
    topology.integrate(scan, pose);
  }
  topology.update();
}

/// The shut door as a teammate tells it.
LayerUpdate shutDoor(double stamp) {
  LayerUpdate layer{"bob", 1, stamp, {}, true, {}};
  layer.contours.push_back({{{kDoorAt, 2.4}, {kDoorAt, 3.6}}, false, stamp, 7, 3});
  return layer;
}

bool isOpen(Topology& topology) {
  topology.update();
  const Route route = topology.route({4.0, 3.0, 0.0}, {10.0, 3.0});
  return route.exists() && route.length < 7.0;
}

const Pose2 kBeforeTheDoor{3.0, 3.0, 0.0};

TEST(Doors, whatWasSeenOpenIsShutWhenATeammateSawItLater) {
  Topology topology({}, testFootprint());
  look(topology, twoRooms(true), kBeforeTheDoor, 100.0);
  ASSERT_TRUE(isOpen(topology));
  topology.setLayer(shutDoor(90.0));
  EXPECT_TRUE(isOpen(topology)) << "own sensing is newer";
  topology.setLayer(shutDoor(150.0));
  EXPECT_FALSE(isOpen(topology));
  topology.removeLayer("bob");
  EXPECT_TRUE(isOpen(topology));
}

TEST(Doors, anotherLookOverrulesTheTeammateAgain) {
  Topology topology({}, testFootprint());
  look(topology, twoRooms(true), kBeforeTheDoor, 100.0);
  topology.setLayer(shutDoor(150.0));
  ASSERT_FALSE(isOpen(topology));
  EXPECT_TRUE(topology.seenThrough().empty());
  look(topology, twoRooms(true), kBeforeTheDoor, 160.0);
  EXPECT_TRUE(isOpen(topology));
  const std::vector<SeenThrough> seen = topology.seenThrough();
  ASSERT_EQ(seen.size(), 1U);
  EXPECT_EQ(seen.front().origin, "bob");
  EXPECT_EQ(seen.front().id, 7U);
  EXPECT_EQ(seen.front().version, 3U);
}

TEST(Doors, aWallToldALittleOffIsTheWallThatIsThere) {
  Topology topology({}, testFootprint());
  look(topology, twoRooms(false), kBeforeTheDoor, 100.0);
  const int vertices = topology.update().vertices;
  LayerUpdate layer = shutDoor(200.0);
  layer.T_odom_peer = {-0.2, 0.1, 0.01};
  topology.setLayer(layer);
  EXPECT_EQ(topology.update().vertices, vertices);
  look(topology, twoRooms(false), kBeforeTheDoor, 210.0);
  EXPECT_TRUE(topology.seenThrough().empty());
}

TEST(Doors, anOutlineWithoutATimeNeverOverrulesOwnSensing) {
  Topology topology({}, testFootprint());
  look(topology, twoRooms(true), kBeforeTheDoor, 100.0);
  LayerUpdate layer = shutDoor(500.0);
  layer.contours.front().stamp = LayerContour{}.stamp;
  topology.setLayer(layer);
  EXPECT_TRUE(isOpen(topology));
  EXPECT_TRUE(topology.seenThrough().empty());
}

TEST(Doors, theNewestOfSeveralLayersCounts) {
  Topology topology({}, testFootprint());
  look(topology, twoRooms(true), kBeforeTheDoor, 100.0);
  topology.setLayer(shutDoor(50.0));
  LayerUpdate newer = shutDoor(150.0);
  newer.origin = "cid";
  topology.setLayer(newer);
  EXPECT_FALSE(isOpen(topology));
  topology.removeLayer("cid");
  EXPECT_TRUE(isOpen(topology)) << "what is left is older than the look";
}

TEST(Doors, whatWasSeenShutIsForgottenWhenItIsRefuted) {
  Topology topology({}, testFootprint());
  look(topology, twoRooms(false), kBeforeTheDoor, 100.0);
  ASSERT_FALSE(isOpen(topology));
  const Polygon outline{{kDoorAt - 0.1, 2.4}, {kDoorAt - 0.1, 3.6}};
  topology.forget({outline, false, 90.0});
  EXPECT_FALSE(isOpen(topology)) << "seen since";
  topology.forget({outline, false, 150.0});
  EXPECT_TRUE(isOpen(topology));
  look(topology, twoRooms(false), kBeforeTheDoor, 160.0);
  EXPECT_FALSE(isOpen(topology));
}

/// Asked for the way again and again while a corner is looked at from which the door is not seen, once a second.
int answersWithAWay(Topology& topology, const TestWorld& world, double begin, double end) {
  int found = 0;
  for (double stamp = begin; stamp < end; stamp += 1.0) {
    ObstacleScan scan = world.scan({1.0, 1.0, 0.0}, 1.5);
    scan.stamp = stamp;
    topology.integrate(scan, {1.0, 1.0, 0.0});
    topology.update();
    found += topology.route({1.0, 1.0, 0.0}, {10.0, 3.0}).exists() ? 1 : 0;
  }
  return found;
}

/// The door is seen open from both sides, and then shut.
Topology seenOpenThenShut() {
  Topology topology({}, testFootprint());
  look(topology, twoRooms(true), {9.0, 3.0, 0.0}, 90.0);
  look(topology, twoRooms(true), kBeforeTheDoor, 100.0);
  for (int i = 0; i < 3; ++i) look(topology, twoRooms(false), kBeforeTheDoor, 101.0 + i);
  return topology;
}

TEST(Doors, whatCameIntoTheOnlyDoorIsDoubtedOutOfView) {
  Topology topology = seenOpenThenShut();
  ASSERT_FALSE(topology.route(kBeforeTheDoor, {10.0, 3.0}).exists());
  EXPECT_EQ(answersWithAWay(topology, twoRooms(false), 104.0, 106.0), 0) << "not at once";
  EXPECT_GE(answersWithAWay(topology, twoRooms(false), 106.0, 110.0), 2) << "it goes and looks";
  for (int i = 0; i < 3; ++i) look(topology, twoRooms(false), kBeforeTheDoor, 111.0 + i);
  EXPECT_FALSE(topology.route(kBeforeTheDoor, {10.0, 3.0}).exists()) << "it is still shut";
}

TEST(Doors, whatCameAndIsOutOfViewIsNoWallToTheLocalPlanner) {
  Topology topology = seenOpenThenShut();
  const auto isWallAt = [&](double y, double stamp) {
    const LocalMap map = topology.localMap({5.0, 3.0}, 8.0, stamp);
    for (double x = kDoorAt - 0.2; x < kDoorAt + 0.2; x += 0.05) {
      if (map.cells[static_cast<std::size_t>(map.frame.indexOf(map.frame.cellOf({x, y})))] == CellState::kOccupied) return true;
    }
    return false;
  };
  EXPECT_TRUE(isWallAt(3.0, 104.0));
  EXPECT_FALSE(isWallAt(3.0, 110.0));
  EXPECT_TRUE(isWallAt(1.0, 110.0)) << "the wall beside it was always there";
}

TEST(Doors, whatIsInViewIsNotDoubted) {
  Topology topology = seenOpenThenShut();
  for (int i = 0; i < 30; ++i) {
    look(topology, twoRooms(false), kBeforeTheDoor, 104.0 + i);
    ASSERT_FALSE(topology.route(kBeforeTheDoor, {10.0, 3.0}).exists()) << i;
  }
}

TEST(Doors, aWallThatWasAlwaysThereIsNotDoubted) {
  Topology topology({}, testFootprint());
  look(topology, twoRooms(false), {9.0, 3.0, 0.0}, 90.0);
  for (int i = 0; i < 3; ++i) look(topology, twoRooms(false), kBeforeTheDoor, 100.0 + i);
  EXPECT_EQ(answersWithAWay(topology, twoRooms(false), 104.0, 140.0), 0);
}

TEST(Doors, aTeammatesWordIsDoubtedLater) {
  Topology topology({}, testFootprint());
  look(topology, twoRooms(true), {9.0, 3.0, 0.0}, 90.0);
  look(topology, twoRooms(true), kBeforeTheDoor, 100.0);
  topology.setLayer(shutDoor(150.0));
  EXPECT_EQ(answersWithAWay(topology, twoRooms(true), 151.0, 155.0), 0);
  EXPECT_GE(answersWithAWay(topology, twoRooms(true), 155.0, 160.0), 2);
  topology.setLayer(shutDoor(170.0));
  EXPECT_FALSE(isOpen(topology)) << "what is told afterwards counts";
}

}  // namespace
}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

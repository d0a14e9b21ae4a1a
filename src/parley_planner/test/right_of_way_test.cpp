// SPDX-License-Identifier: BSD-3-Clause
// Who waits for whom, and for how long, as one robot's planner has it.
#include "planner_fixture.h"

namespace parley {
namespace {

using RightOfWayTest = PlannerTest;

TEST_F(RightOfWayTest, WhomAStrangerLeavesNoRouteMakesRoomAfterAWhile) {
  route_ = {};
  committed_ = SampledTrajectory::standing(odometry_.pose, 0.0);
  TrackedObject stranger;
  stranger.position = {4.2, 5.0};
  stranger.radius = 0.4;
  stranger.observations = 20;
  const auto furthestIn = [this](double from, double to) {
    double furthest = 0.0;
    for (double now = from; now < to; now += 0.1) {
      be(committed_.at(now));
      scan_.stamp = now;
      const PlanResult result = plan(now);
      if (!result.keep_committed) committed_ = result.trajectory;
      furthest = std::max(furthest, (odometry_.pose.position() - Eigen::Vector2d(3.0, 5.0)).norm());
    }
    return furthest;
  };
  tracks_ = {stranger};
  EXPECT_LT(furthestIn(0.0, 10.0), 0.01) << "what never moved does not go away for room";
  tracks_.front().has_moved = true;
  EXPECT_LT(furthestIn(10.0, 11.5), 0.01) << "it may go by itself";
  EXPECT_GT(furthestIn(11.5, 25.0), 0.3);
}

TEST_F(RightOfWayTest, WhoWaitsForATeammateThatDoesNotMakeRoomTriesAgainFromElsewhere) {
  for (const double wall : {0.0, 5.5}) setCells(&map_, 3.9, wall, 6.0, wall + 4.5, CellState::kOccupied);
  committed_ = SampledTrajectory::standing(odometry_.pose, 0.0);
  bool has_waited = false;
  const auto furthestIn = [&](double from, double to) {
    double furthest = 0.0;
    for (double now = from; now < to; now += 0.1) {
      PeerMotion mate;
      mate.id = 9;
      mate.footprint = robotFootprint();
      mate.trajectory = SampledTrajectory::standing({4.2, 5.0, 0.0}, now);
      mate.heard = scan_.stamp = now;
      mate.intent = {{0.0, 9, 0}, {{4.2, 5.0}}};
      peers_ = {mate};
      be(committed_.at(now));
      const PlanResult result = plan(now);
      has_waited = has_waited || result.status.is(PlanCode::kWaiting);
      if (!result.keep_committed) committed_ = result.trajectory;
      furthest = std::max(furthest, (odometry_.pose.position() - Eigen::Vector2d(3.0, 5.0)).norm());
    }
    return furthest;
  };
  EXPECT_LT(furthestIn(0.0, 8.0), 0.1);
  EXPECT_TRUE(has_waited);
  EXPECT_GT(furthestIn(8.0, 20.0), 0.5);
}

/// A room with a corridor of 1.2 m that leads out of it.
TEST_F(RightOfWayTest, WhoHasBeenDeepInACorridorGoesFirstUntilItIsOut) {
  World world(24, 10, true);
  world.fill(0.3, 3.0, 2.7, 7.0, false);
  world.fill(2.5, 4.4, 23.7, 5.6, false);
  map_ = seenMap(world);
  goal_ = {23.0, 5.0};
  std::mt19937 random(1);
  double now = 0.0;
  const auto priorityAt = [&](double x) {
    odometry_.pose = {x, 5.0, 0.0};
    route_.points = {{x, 5.0}, goal_};
    scan_ = castScan(world, odometry_.pose, now, 0.0, random);
    now += 1.0;
    return plan(now).intent.right.priority;
  };
  EXPECT_EQ(priorityAt(1.5), 1.0);
  EXPECT_EQ(priorityAt(8.0), 1.0);
  EXPECT_EQ(priorityAt(10.5), 1.5);
  EXPECT_EQ(priorityAt(18.5), 2.0);
  EXPECT_EQ(priorityAt(4.0), 2.0) << "pushed back, it keeps what it has until it is out";
  EXPECT_EQ(priorityAt(1.5), 1.0);
  EXPECT_EQ(priorityAt(18.5), 2.0);
  planner_.reset();
  EXPECT_EQ(priorityAt(18.5), 1.0) << "where it came from is forgotten";
}

}  // namespace
}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

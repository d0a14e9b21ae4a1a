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
class CorridorTest : public RightOfWayTest {
 protected:
  CorridorTest() {
    world_.fill(0.3, 3.0, 2.7, 7.0, false);
    world_.fill(2.5, 4.4, 23.7, 5.6, false);
    map_ = seenMap(world_);
    goal_ = {23.0, 5.0};
  }
  PlanResult planAt(double x) {
    odometry_.pose = {x, 5.0, 0.0};
    route_.points = {{x, 5.0}, goal_};
    scan_ = castScan(world_, odometry_.pose, now_, 0.0, random_);
    now_ += 1.0;
    return plan(now_);
  }
  double priorityAt(double x) { return planAt(x).intent.right.priority; }
  PeerMotion mate(std::uint32_t id, const Pose2& pose, const RightOfWay& right, const Eigen::Vector2d& to) const {
    PeerMotion motion;
    motion.id = id;
    motion.footprint = robotFootprint();
    motion.trajectory = SampledTrajectory::standing(pose, now_);
    motion.heard = now_;
    motion.intent = {right, {pose.position(), to}};
    return motion;
  }

  World world_{24, 10, true};
  std::mt19937 random_{1};
  double now_ = 0.0;
};

TEST_F(CorridorTest, WhoHasBeenDeepInItGoesFirstUntilItIsWellOut) {
  EXPECT_EQ(priorityAt(1.5), 1.0);
  EXPECT_EQ(priorityAt(8.0), 1.0);
  EXPECT_EQ(priorityAt(10.5), 1.5);
  EXPECT_EQ(priorityAt(18.5), 2.0);
  EXPECT_EQ(priorityAt(4.0), 2.0) << "pushed back, it keeps what it has until it is out";
  EXPECT_EQ(priorityAt(3.3), 2.0);
  EXPECT_EQ(priorityAt(1.9), 2.0) << "in the mouth it could still be pushed back";
  EXPECT_EQ(priorityAt(1.2), 1.0);
  EXPECT_EQ(priorityAt(18.5), 2.0);
  planner_.reset();
  EXPECT_EQ(priorityAt(18.5), 1.0) << "where it came from is forgotten";
}

TEST_F(CorridorTest, WhoIsPushedIntoItDoesNotGoFirstForThat) {
  priorityAt(1.5);
  goal_ = {1.0, 5.0};
  for (double x = 4.0; x < 12.0; x += 1.0) {
    peers_ = {mate(9, {x - 1.2, 5.0, 0.0}, {1.0, 9, 0}, {x + 6.0, 5.0})};
    const RightOfWay right = planAt(x).intent.right;
    EXPECT_EQ(right.holder, 9U) << x;
    EXPECT_EQ(right.priority, 1.0) << x;
  }
  peers_.clear();
  EXPECT_EQ(priorityAt(11.0), 1.0);
}

}  // namespace
}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

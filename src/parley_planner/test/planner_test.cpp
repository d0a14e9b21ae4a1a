// SPDX-License-Identifier: BSD-3-Clause
#include <limits>

#include "parley_geometry/option_conformance.h"
#include "planner_fixture.h"

namespace parley {
namespace {

TEST_F(PlannerTest, DrivesToTheGoal) {
  const PlanResult result = plan(0.0);
  EXPECT_TRUE(result.status.is(PlanCode::kDriving));
  EXPECT_FALSE(result.keep_committed);
  EXPECT_EQ(motionFlaw(result.trajectory.points(), robotLimits()), "");
  EXPECT_NEAR(result.trajectory.startTime(), 0.05, 1e-9);
  EXPECT_NEAR(result.local_goal.x(), 7.5, 0.11);
  EXPECT_GT(result.path.size(), 10U);
  EXPECT_GT(result.speed_bound, 0.3);
  EXPECT_GT(result.trajectory_time, 0.0);
  goal_ = odometry_.pose.position();
  EXPECT_LT(plan(0.1).trajectory_time, 0.0);  // it makes none
}

TEST_F(PlannerTest, KeepsWhatIsCommittedBetweenPlans) {
  committed_ = plan(0.0).trajectory;
  EXPECT_TRUE(plan(0.02).keep_committed);
}

TEST_F(PlannerTest, BrakesWhenTheWayIsClosed) {
  committed_ = plan(0.0).trajectory;
  const TrajectoryPoint there = committed_.at(1.0);
  be(there);
  setCells(&map_, there.pose.x + 0.7, 0.0, there.pose.x + 0.9, 10.0, CellState::kOccupied);
  const PlanResult result = plan(1.0);
  EXPECT_TRUE(result.status.is(PlanCode::kBlocked));
  ASSERT_FALSE(result.keep_committed);
  EXPECT_EQ(motionFlaw(result.trajectory.points(), robotLimits()), "");
  EXPECT_LT(result.trajectory.duration(), 1.1);
  // Level-triggered: asked again while still moving, it brakes again.
  committed_ = result.trajectory;
  be(committed_.at(1.1));
  const PlanResult again = plan(1.1);
  ASSERT_FALSE(again.keep_committed);
  EXPECT_LT(again.trajectory.points()[2].twist.speed, odometry_.twist.speed);
}

TEST_F(PlannerTest, SaysWhatBlocks) {
  for (const double side : {4.0, 6.0}) setCells(&map_, 0.0, side - 0.1, 10.0, side + 0.1, CellState::kOccupied);
  setCells(&map_, 4.0, 4.0, 4.2, 6.0, CellState::kOccupied);
  setCells(&map_, 2.0, 4.0, 2.2, 6.0, CellState::kOccupied);
  route_.points = {{3.0, 5.0}, {8.0, 5.0}};
  committed_ = SampledTrajectory::standing(odometry_.pose, 0.0);
  PlanResult result;
  const auto live = [&](int first, int last) {
    for (int k = first; k < last; ++k) {
      be(committed_.at(0.1 * k));
      result = plan(0.1 * k);
      if (!result.keep_committed) committed_ = result.trajectory;
    }
  };
  live(1, 100);
  EXPECT_TRUE(result.status.is(PlanCode::kBlocked));
  EXPECT_EQ(result.status.text, "blocked");
  TrackedObject track;
  track.position = {4.1, 5.0};
  track.radius = 0.4;
  tracks_ = {track};
  live(100, 110);
  EXPECT_TRUE(result.status.is(PlanCode::kBlocked));
  EXPECT_EQ(result.status.text, "blocked by something that moved");
  // A teammate close behind is not what it waits for, one before it is.
  PeerMotion mate;
  mate.id = 9;
  mate.footprint = robotFootprint();
  mate.trajectory = SampledTrajectory::standing({odometry_.pose.x - 1.2, 5.0, 0.0}, 11.0);
  mate.heard = 11.0;
  mate.intent = {{1.0, 9, 0}, {{odometry_.pose.x - 1.2, 5.0}}};
  peers_ = {mate};
  live(110, 120);
  EXPECT_TRUE(result.status.is(PlanCode::kBlocked));
  peers_[0].trajectory = SampledTrajectory::standing({odometry_.pose.x + 1.2, 5.0, 0.0}, 12.0);
  peers_[0].heard = 12.0;
  peers_[0].intent.way = {{odometry_.pose.x + 1.2, 5.0}};
  tracks_.clear();
  live(120, 130);
  EXPECT_TRUE(result.status.is(PlanCode::kWaiting));
}

TEST_F(PlannerTest, TellsWhichNarrowPlaceItDidNotGetThrough) {
  setCells(&map_, 4.0, 0.0, 4.2, 4.8, CellState::kOccupied);
  setCells(&map_, 4.0, 5.2, 4.2, 10.0, CellState::kOccupied);
  committed_ = SampledTrajectory::standing(odometry_.pose, 0.0);
  const auto toldWhile = [&](double from, double until) {
    std::vector<Eigen::Vector2d> told;
    for (double now = from; now < until; now += 0.1) {
      be(committed_.at(now));
      const PlanResult result = plan(now);
      if (!result.keep_committed) committed_ = result.trajectory;
      if (!result.impassable) continue;
      EXPECT_TRUE(result.status.is(PlanCode::kBlocked));
      told.push_back(*result.impassable);
    }
    return told;
  };
  EXPECT_TRUE(toldWhile(0.1, 5.0).empty()) << "it tries for a while";
  const std::vector<Eigen::Vector2d> told = toldWhile(5.0, 18.0);
  ASSERT_EQ(told.size(), 1U) << "and then anew";
  EXPECT_LT((told[0] - Eigen::Vector2d(4.1, 5.0)).norm(), 0.2);
  TrackedObject track;
  track.position = {4.4, 5.0};
  track.radius = 0.3;
  track.has_moved = true;
  track.observations = 100;
  tracks_ = {track};
  EXPECT_TRUE(toldWhile(18.0, 32.0).empty()) << "what stands there may drive off";
}

TEST_F(PlannerTest, ArrivesWithHysteresis) {
  odometry_.pose = {7.9, 5.0, 0.0};
  EXPECT_TRUE(plan(0.0).status.is(PlanCode::kArrived));
  odometry_.pose = {7.75, 5.0, 0.0};
  EXPECT_TRUE(plan(0.1).status.is(PlanCode::kArrived));
  odometry_.pose = {7.5, 5.0, 0.0};
  EXPECT_TRUE(plan(0.2).status.is(PlanCode::kDriving));
  odometry_.pose = {7.9, 5.0, 0.0};
  EXPECT_TRUE(plan(0.3).status.is(PlanCode::kArrived));
  goal_ = {5.0, 5.0};
  route_.points.back() = goal_;
  EXPECT_TRUE(plan(0.4).status.is(PlanCode::kDriving));
}

TEST_F(PlannerTest, WithoutARouteWhatIsCommittedStands) {
  route_ = {};
  EXPECT_TRUE(plan(0.0).status.is(PlanCode::kNoRoute));
  route_.points = {{3.0, 5.0}, {8.0, 5.0}};
  committed_ = plan(0.1).trajectory;
  route_.points.clear();
  const PlanResult result = plan(0.2);
  EXPECT_TRUE(result.status.is(PlanCode::kNoRoute));
  EXPECT_TRUE(result.keep_committed);
}

TEST_F(PlannerTest, WhatIsCommittedIsKeptNoFasterThanSightAllows) {
  committed_ = plan(0.0).trajectory;
  const TrajectoryPoint there = committed_.at(1.2);
  be(there);
  Route behind_a_wall = route_;
  behind_a_wall.points = {there.pose.position(), {there.pose.x, 9.0}};
  setCells(&map_, 0.0, 5.3, 10.0, 5.4, CellState::kOccupied);
  TrackedObject first_sight;  // far enough aside that it does not shut the way
  first_sight.stamp = 1.2;
  first_sight.position = there.pose * Eigen::Vector2d(1.5, -1.5);
  first_sight.radius = 0.3;
  first_sight.observations = 1;
  for (const Route& route : {Route{}, behind_a_wall}) {
    route_ = route;
    tracks_.clear();
    EXPECT_TRUE(plan(1.2).keep_committed);
    tracks_ = {first_sight};
    const PlanResult result = plan(1.4);
    EXPECT_LT(result.speed_bound, there.twist.speed - 0.3);
    ASSERT_FALSE(result.keep_committed);
    EXPECT_EQ(motionFlaw(result.trajectory.points(), robotLimits()), "");
    EXPECT_LT(result.trajectory.duration(), 1.1);
    EXPECT_NEAR(result.trajectory.points().back().pose.y, 5.0, 0.05);
  }
}

TEST_F(PlannerTest, WhoBacksUpHeedsSightToo) {
  std::vector<TrajectoryPoint> points{{1.0, {5.0, 5.0, 0.0}, {-0.8, 0.0}}};
  while (points.size() < 30) {
    TrajectoryPoint p = points.back();
    p.time += 0.05;
    p.pose.x -= 0.04;
    points.push_back(p);
  }
  const std::vector<TrajectoryPoint> stop = brakingTrajectory(points.back(), robotLimits(), 0.05).points();
  points.insert(points.end(), stop.begin() + 1, stop.end());
  committed_ = SampledTrajectory(points);
  be(committed_.at(1.2));
  route_ = {};
  TrackedObject first_sight;
  first_sight.stamp = 1.2;
  first_sight.radius = 0.3;
  first_sight.observations = 1;
  first_sight.position = odometry_.pose * Eigen::Vector2d(0.9, -0.8);  // it leaves this one behind
  tracks_ = {first_sight};
  EXPECT_TRUE(plan(1.2).keep_committed);
  first_sight.position = odometry_.pose * Eigen::Vector2d(-0.9, -0.8);
  tracks_ = {first_sight};
  const PlanResult result = plan(1.3);
  ASSERT_FALSE(result.keep_committed);
  EXPECT_EQ(motionFlaw(result.trajectory.points(), robotLimits()), "");
  EXPECT_LT(result.trajectory.duration(), 0.7);
}

TEST_F(PlannerTest, TurnsOnTheSpotFirst) {
  odometry_.pose.yaw = 2.8;
  const PlanResult result = plan(0.0);
  ASSERT_FALSE(result.keep_committed);
  const auto& points = result.trajectory.points();
  EXPECT_EQ(motionFlaw(points, robotLimits()), "");
  EXPECT_EQ(points[10].twist.speed, 0.0);
  EXPECT_GT(std::abs(points[10].twist.turn_rate), 1.0);
  // While it turns it is not interrupted.
  committed_ = result.trajectory;
  be(committed_.at(1.0));
  EXPECT_TRUE(plan(1.0).keep_committed);
}

TEST_F(PlannerTest, StopsAtOnceWhenTheRouteTurnsBack) {
  committed_ = plan(0.0).trajectory;
  const TrajectoryPoint there = committed_.at(1.0);
  be(there);
  goal_ = {1.0, 5.0};
  route_.points = {there.pose.position(), goal_};
  const PlanResult result = plan(1.0);
  ASSERT_FALSE(result.keep_committed);
  EXPECT_EQ(motionFlaw(result.trajectory.points(), robotLimits()), "");
  const double least = there.twist.speed * there.twist.speed / (2.0 * robotLimits().acceleration);
  EXPECT_LT(result.trajectory.length(), 1.4 * least + 0.1);
}

TEST_F(PlannerTest, StopsOnWhatIsCommittedWhenTheRouteTurnsBack) {
  std::vector<TrajectoryPoint> points{{0.9, {3.0, 5.0, 0.4}, {1.6, 0.6}}};  // about to bend the other way, as before a wall
  while (points.size() < 60) {
    TrajectoryPoint p = points.back();
    p.time += 0.05;
    p.twist.turn_rate = std::max(-1.2, p.twist.turn_rate - 0.15);
    p.pose = integrateTwist(points.back().pose, 1.6, 0.5 * (points.back().twist.turn_rate + p.twist.turn_rate), 0.05);
    points.push_back(p);
  }
  committed_ = SampledTrajectory(points);
  const TrajectoryPoint there = committed_.at(1.0);
  be(there);
  goal_ = {1.0, 4.0};
  route_.points = {there.pose.position(), goal_};
  const PlanResult result = plan(1.0);
  ASSERT_FALSE(result.keep_committed);
  EXPECT_TRUE(result.status.is(PlanCode::kDriving)) << result.status.text;
  EXPECT_NEAR(result.trajectory.points().back().twist.speed, 0.0, 1e-9);
  for (const TrajectoryPoint& p : result.trajectory.points()) {
    double nearest = 1e9;
    for (double time = 0.9; time < 3.0; time += 0.01)
      nearest = std::min(nearest, (p.pose.position() - committed_.at(time).pose.position()).norm());
    EXPECT_LT(nearest, 0.03) << p.time;
  }
}

TEST_F(PlannerTest, StartsFromTheOdometryWhenItIsOffTheTrajectory) {
  committed_ = plan(0.0).trajectory;
  odometry_.pose = {3.2, 5.5, 0.0};
  odometry_.twist = {0.3, 0.0};
  const PlanResult result = plan(1.0);
  ASSERT_FALSE(result.keep_committed);
  EXPECT_NEAR(result.trajectory.points().front().pose.y, 5.5, 0.01);
}

TEST_F(PlannerTest, WhatIsNotDrivenIsNotToldAnyLonger) {
  committed_ = plan(0.0).trajectory;  // to x = 8; the controller stopped the robot on its way
  odometry_.pose = {4.5, 5.0, 0.0};
  route_ = {};
  const double later = committed_.endTime() + 1.0;
  PlanResult result = plan(later);
  ASSERT_FALSE(result.keep_committed);
  EXPECT_NEAR(result.trajectory.at(later).pose.x, 4.5, 1e-6);
  EXPECT_EQ(result.trajectory.points().back().twist.speed, 0.0);
  committed_ = result.trajectory;
  EXPECT_TRUE(plan(later + 0.1).keep_committed);
}

TEST_F(PlannerTest, BadInputIsNotDrivenOn) {
  odometry_.pose.x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(plan(0.0).status.is(PlanCode::kNoPath));
  odometry_.pose.x = 3.0;
  map_.cells.pop_back();
  EXPECT_TRUE(plan(0.1).status.is(PlanCode::kNoPath));
  map_ = {};
  EXPECT_TRUE(plan(0.2).keep_committed);
}

TEST_F(PlannerTest, TimeGoingBackStartsAfresh) {
  committed_ = plan(10.0).trajectory;
  committed_ = {};
  EXPECT_FALSE(plan(0.0).keep_committed);
  planner_.reset();
  EXPECT_FALSE(plan(0.0).keep_committed);
}

TEST(PlannerConstruction, RefusesBadOptions) {
  PlannerOptions options;
  options.look_ahead = -1.0;
  EXPECT_THROW(Planner(options, robotFootprint(), robotLimits()), std::invalid_argument);
  EXPECT_THROW(Planner({}, Footprint{}, robotLimits()), std::invalid_argument);
  EXPECT_THROW(Planner({}, robotFootprint(), MotionLimits{}), std::invalid_argument);
  Planner moved = Planner({}, robotFootprint(), robotLimits());
  moved = Planner({}, robotFootprint(), robotLimits());
  moved.reset();
}

TEST(PlannerConfig, FileEqualsDefaults) { expectFileHoldsDefaults<PlannerOptions>(PARLEY_PLANNER_CONFIG); }

TEST(PlannerReadme, ListsTheOptions) { expectTableIn<PlannerOptions>(PARLEY_PLANNER_README); }

}  // namespace
}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

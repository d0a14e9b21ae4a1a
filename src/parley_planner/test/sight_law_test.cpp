// SPDX-License-Identifier: BSD-3-Clause
#include "sight_law.h"

#include <gtest/gtest.h>

#include "scenes.h"

namespace parley {
namespace {

/// A corridor that turns left.
World corner() {
  World world(10, 10, true);
  world.fill(0, 4.2, 6, 5.8, false);
  world.fill(4.4, 4.2, 6, 10, false);
  return world;
}

class SightLawTest : public testing::Test {
 protected:
  void look(const World& world, const Pose2& pose, double now, const std::vector<TrackedObject>& tracks = {}) {
    std::mt19937 random(1);
    const ObstacleScan scan = castScan(world, pose, now, 0.0, random);
    const Surroundings surroundings(seenMap(world), scan, pose, tracks);
    law_.observe(surroundings, scan, pose, tracks, pose, now);
  }
  double speedAt(const Pose2& pose) const { return law_.speedFor(law_.gapAt(pose.position())); }
  SightLawOptions options_;
  SightLaw law_{options_, robotLimits()};
};

TEST_F(SightLawTest, BothCanStop) {
  for (double gap = 0.9; gap < 5.0; gap += 0.1) {
    const double v = law_.speedFor(gap), t = options_.reaction_time, a = robotLimits().acceleration;
    if (v < options_.least_speed + 0.01) continue;
    EXPECT_NEAR(2.0 * (v * t + v * v / (2.0 * a)) + options_.contact_distance, gap, 1e-6);
  }
  EXPECT_NEAR(law_.speedFor(0.0), options_.least_speed, 1e-9);
}

TEST_F(SightLawTest, StraightCorridorIsFast) {
  World world(10, 10, true);
  world.fill(0, 4.2, 10, 5.8, false);
  look(world, {3.0, 5.0, 0.0}, 0.0);
  EXPECT_GT(speedAt({3.0, 5.0, 0.0}), 1.9);
}

TEST_F(SightLawTest, BlindCornerIsSlower) {
  const World world = corner();
  const Pose2 pose{3.6, 4.8, 0.0};
  look(world, pose, 0.0);
  EXPECT_LT(speedAt(pose), 1.95);
  EXPECT_GT(speedAt(pose), 1.2);
  const ReferencePath path(resampled({{3.6, 4.8}, {5.2, 4.8}, {5.2, 9.0}}, 0.1));
  const std::vector<double> bounds = law_.bounds(path, 0.0, 1.5);
  ASSERT_EQ(bounds.size(), path.points().size());
  EXPECT_LT(bounds.back(), bounds.front() + 1e-9);  // what is hidden lies ahead
}

TEST_F(SightLawTest, WhoBacksTowardsABlindCornerIsAsSlow) {
  const World world = corner();
  const Pose2 ahead{3.6, 4.8, 0.0}, behind{3.6, 4.8, kPi};  // the corner
  look(world, ahead, 0.0);
  const double gap = law_.gapAt(ahead.position());
  const ReferencePath path(resampled({{3.6, 4.8}, {5.2, 4.8}, {5.2, 9.0}}, 0.1));
  const std::vector<double> bounds = law_.bounds(path, 0.0, 1.5);
  law_.reset();
  look(world, behind, 0.0);
  EXPECT_NEAR(law_.gapAt(ahead.position(), true), gap, 0.15);
  EXPECT_GT(law_.gapAt(ahead.position()), gap + 0.5);  // of one that drives away from it
  const std::vector<double> backwards = law_.bounds(path, 0.0, -1.5, true);
  ASSERT_EQ(backwards.size(), bounds.size());
  for (std::size_t i = 0; i < bounds.size(); ++i) EXPECT_NEAR(backwards[i], bounds[i], 0.1) << i;
}

TEST_F(SightLawTest, InANarrowCorridorAnIntruderDrivesInItsMiddleAtFullSpeed) {
  // However the corridors of a crossing lie to the cells, nobody in the other one is much further off than it would be to drive.
  for (int k = 0; k < 10; ++k) {
    const double middle = 5.0 + 0.01 * k, half = 0.65;
    World world(10, 10, true);
    world.fill(0, middle - half, 10, middle + half, false);
    world.fill(middle - half, 0, middle + half, 10, false);
    law_.reset();
    const Pose2 pose{middle - 2.0, middle, 0.0};
    for (const double now : {0.0, 1.0}) look(world, pose, now);  // walls are believed at the second look
    EXPECT_FALSE(law_.possibleAt({middle, middle}));
    EXPECT_TRUE(law_.possibleAt({middle, middle + 1.2}));
    EXPECT_LT(law_.gapAt(pose.position()), 2.0 + 1.2 + 0.3) << "corridor's middle at " << middle;
  }
}

TEST_F(SightLawTest, WhoItselfIsOffTheMiddleHasNoMoreRoomForIt) {
  // A corridor, and a door from it into a room; the robot leaves the room close to the right jamb.
  World world(10, 10, true);
  world.fill(0, 2.0, 10, 3.5, false);
  world.fill(3.0, 3.5, 4.4, 3.7, false);
  world.fill(1.0, 3.7, 8.0, 8.0, false);
  const Pose2 pose{4.2, 4.0, -2.2};
  for (const double now : {0.0, 1.0}) look(world, pose, now);
  const Eigen::Vector2d hidden(4.9, 2.75), past_the_jamb(4.2, 3.5);
  ASSERT_TRUE(law_.possibleAt(hidden));
  EXPECT_LT(law_.gapAt(pose.position()), (hidden - past_the_jamb).norm() + (past_the_jamb - pose.position()).norm() + 0.6);
}

TrackedObject walker(const Eigen::Vector2d& position, const Eigen::Vector2d& velocity) {
  TrackedObject track;
  track.id = 1;
  track.position = position;
  track.velocity = velocity;
  track.radius = 0.3;
  track.observations = 10;
  track.moving = track.has_moved = true;
  return track;
}

TEST_F(SightLawTest, AKnownTeamHidesNobodyButIsMetAsEver) {
  const World world = corner();
  const Pose2 pose{3.6, 4.8, 0.0};
  look(world, pose, 0.0);
  const double unknown = speedAt(pose);
  law_.reset();
  law_.setTeamKnown(true);
  look(world, pose, 0.0);
  EXPECT_GT(speedAt(pose), unknown + 0.1);
  law_.reset();
  look(world, pose, 0.0, {walker({5.4, 4.8}, {-1.0, 0.0})});
  const double met = speedAt(pose);
  law_.setTeamKnown(false);
  law_.reset();
  look(world, pose, 0.0, {walker({5.4, 4.8}, {-1.0, 0.0})});
  EXPECT_NEAR(speedAt(pose), met, 1e-9);
  EXPECT_LT(met, 1.3);
}

TEST_F(SightLawTest, WhoWalksAheadMayTurnRound) {
  World world(10, 10, true);
  world.fill(0.5, 0.5, 9.5, 9.5, false);
  const ReferencePath path(resampled({{2.0, 5.0}, {8.0, 5.0}}, 0.1));
  const auto boundBehind = [&](const Eigen::Vector2d& there, const Eigen::Vector2d& velocity) {
    law_.reset();
    look(world, {2.0, 5.0, 0.0}, 0.0, {walker(there, velocity)});
    return law_.bounds(path, 0.0, 1.0).front();
  };
  const double v = boundBehind({4.5, 5.0}, {1.2, 0.0});
  const double t = options_.reaction_time, a = robotLimits().acceleration;
  // It stands before somebody who turns now, at the same speed, is there.
  const double needed = v * t + v * v / (2.0 * a) + 1.2 * (t + v / a);
  EXPECT_NEAR(needed, 2.5 - 0.3 - options_.half_length, 0.01);
  EXPECT_GT(boundBehind({4.5, 7.0}, {1.2, 0.0}), 1.8);   // walks past
  EXPECT_GT(boundBehind({1.0, 5.0}, {-1.2, 0.0}), 1.8);  // is behind
}

TEST_F(SightLawTest, NothingHidesWhereNobodyFits) {
  World world(10, 10, true);
  world.fill(1, 3.5, 5, 6.5, false);
  world.fill(5, 4.9, 9, 5.1, false);  // a crack
  look(world, {3.0, 5.0, 0.0}, 0.0);
  EXPECT_GE(speedAt({3.0, 5.0, 0.0}), 2.0);
}

TEST_F(SightLawTest, RemembersWhatItHasSeenForAWhile) {
  World open(10, 10, true);
  open.fill(1, 1, 9, 5, false);
  open.fill(1, 5, 9, 9, false);
  look(open, {5.0, 5.0, 0.0}, 0.0);
  EXPECT_FALSE(law_.possibleAt({5.0, 7.0}));
  World closed = open;
  closed.fill(0, 4.0, 10, 4.2, true);  // now a wall hides what lies above it
  look(closed, {5.0, 3.0, 0.0}, 0.1);
  EXPECT_FALSE(law_.possibleAt({5.0, 7.0}));
  for (int k = 2; k < 40; ++k) look(closed, {5.0, 3.0, 0.0}, 0.1 * k);
  EXPECT_TRUE(law_.possibleAt({5.0, 7.0}));
  law_.reset();
  EXPECT_TRUE(law_.possibleAt({5.0, 2.0}));
  EXPECT_EQ(law_.gapAt({5.0, 2.0}), 0.0);
}

TEST_F(SightLawTest, OthersDriveOnWhileNobodyLooks) {
  World open(10, 10, true);
  open.fill(1, 1, 9, 9, false);
  look(open, {5.0, 5.0, 0.0}, 0.0);
  World closed = open;
  closed.fill(0, 4.0, 10, 4.2, true);
  look(closed, {5.0, 3.0, 0.0}, 0.1);
  ASSERT_FALSE(law_.possibleAt({5.0, 7.0}));
  look(closed, {5.0, 3.0, 0.0}, 4.0);
  EXPECT_TRUE(law_.possibleAt({5.0, 7.0}));
}

TEST_F(SightLawTest, ApproachingTracksCount) {
  World world(10, 10, true);
  world.fill(0, 3, 10, 7, false);
  TrackedObject track;
  track.position = {5.0, 5.0};
  track.velocity = {-1.5, 0.0};
  track.radius = 0.3;
  track.moving = track.has_moved = true;
  track.observations = 9;
  look(world, {3.0, 5.0, 0.0}, 0.0, {track});
  const double approached = speedAt({3.0, 5.0, 0.0});
  EXPECT_LT(approached, 1.5);
  track.velocity = {1.5, 0.0};
  law_.reset();
  look(world, {3.0, 5.0, 0.0}, 0.0, {track});
  EXPECT_GT(speedAt({3.0, 5.0, 0.0}), approached + 0.2);
}

TEST_F(SightLawTest, WhatComesIntoSightCountsUntilItHasStood) {
  World world(10, 10, true);
  world.fill(0, 3, 10, 7, false);
  const Pose2 pose{3.0, 5.0, 0.0};
  for (int k = 0; k < 10; ++k) look(world, pose, 0.1 * k);
  EXPECT_GT(speedAt(pose), 1.9);
  World with_box = world;
  with_box.fill(4.8, 4.7, 5.2, 5.3, true);
  look(with_box, pose, 1.0);
  EXPECT_LT(speedAt(pose), 1.5);
  for (int k = 11; k < 18; ++k) look(with_box, pose, 0.1 * k);
  EXPECT_GT(speedAt(pose), 1.6);  // it stands; what it hides is all that is left
}

TEST_F(SightLawTest, ARobotThatGotOutOfSightIsNotForgotten) {
  World world(10, 10, true);
  world.fill(0, 1, 10, 9, false);
  world.fill(4.4, 4.4, 5.2, 5.6, true);  // a box to hide behind
  const Pose2 pose{3.0, 5.0, 0.0};
  TrackedObject track;
  track.position = {5.9, 5.0};
  track.radius = 0.3;
  track.moving = track.has_moved = true;
  track.observations = 9;
  const auto forget = [&] {  // all is seen free from all sides, so that nothing can be anywhere
    law_.reset();
    const World empty(10, 10, false);
    for (const double y : {1.5, 5.0, 8.5}) look(empty, {5.0, y, 0.0}, 0.0);
  };
  forget();
  for (int k = 1; k < 8; ++k) look(world, pose, 0.1 * k);
  const double alone = speedAt(pose);
  forget();
  look(world, pose, 0.1, {track});
  for (int k = 2; k < 8; ++k) look(world, pose, 0.1 * k);
  EXPECT_LT(speedAt(pose), alone - 0.2);
}

}  // namespace
}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

// SPDX-License-Identifier: BSD-3-Clause
// What is done about the unexpected: emergency_stop and fresh_pieces.
#include <gtest/gtest.h>

#include "emergency_stop.h"
#include "fresh_pieces.h"
#include "scenes.h"

namespace parley {
namespace {

constexpr double kStep = 0.05;  // [s]

/// Driving at `speed` on a circle, then straight.
SampledTrajectory bend(const TrajectoryPoint& from, double turned, double speed) {
  std::vector<TrajectoryPoint> points{from};
  points.back().twist = {speed, from.twist.turn_rate};
  while (points.size() < 60) {
    TrajectoryPoint p = points.back();
    p.time += kStep;
    p.twist.turn_rate = std::abs(p.pose.yaw - from.pose.yaw) < turned ? from.twist.turn_rate : 0.0;
    p.pose = integrateTwist(points.back().pose, speed, p.twist.turn_rate, kStep);
    points.push_back(p);
  }
  return SampledTrajectory(std::move(points));
}

std::vector<DatedReturn> wall(double from, double to, double y, double fresh_from, double fresh_to) {
  std::vector<DatedReturn> returns;
  for (double x = from; x < to; x += 0.03) {
    const Eigen::Vector2d p(x, y + (returns.size() % 2 ? 0.02 : -0.02));
    returns.push_back({p, p.norm(), x >= fresh_from && x < fresh_to});
  }
  return returns;
}

}  // namespace

TEST(BrakingAlong, StaysOnThePath) {
  const TrajectoryPoint start{2.0, {5.0, 5.0, 0.4}, {1.2, 0.9}};
  const SampledTrajectory path = bend(start, 0.5, 1.2);
  const SampledTrajectory stop = brakingAlong(path, start, robotLimits(), kStep);
  EXPECT_EQ(motionFlaw(stop.points(), robotLimits()), "");
  EXPECT_NEAR(stop.length(), 1.2 * 1.2 / (2.0 * robotLimits().acceleration), 0.05);
  for (const TrajectoryPoint& p : stop.points()) {
    double nearest = 1e9;
    for (const TrajectoryPoint& q : path.points()) nearest = std::min(nearest, (p.pose.position() - q.pose.position()).norm());
    EXPECT_LT(nearest, 0.06);
  }
}

TEST(BrakingAlong, DoesNotDriftWhenItIsBegunAnew) {
  const MotionLimits limits = robotLimits();
  // From straight on into a bend, as tight as the drive can take it up at this speed.
  std::vector<TrajectoryPoint> points{{2.0, {5.0, 5.0, 0.4}, {1.8, 0.0}}};
  while (points.size() < 60) {
    TrajectoryPoint p = points.back();
    p.time += kStep;
    p.twist.turn_rate = std::min(1.4, p.twist.turn_rate + 0.5 * limits.turn_acceleration * kStep);
    p.pose = integrateTwist(points.back().pose, 1.8, 0.5 * (points.back().twist.turn_rate + p.twist.turn_rate), kStep);
    points.push_back(p);
  }
  const SampledTrajectory path(points);
  SampledTrajectory stop = brakingAlong(path, path.at(2.2), limits, kStep);
  for (int plan = 1; plan < 8; ++plan) stop = brakingAlong(stop, stop.at(2.2 + 0.1 * plan), limits, kStep);
  const Pose2 end = stop.points().back().pose;
  double nearest = 1e9, yaw = 0.0;
  for (double time = 2.0; time < path.endTime(); time += 0.005) {
    const double distance = (path.at(time).pose.position() - end.position()).norm();
    if (distance < nearest) yaw = path.at(time).pose.yaw;
    nearest = std::min(nearest, distance);
  }
  EXPECT_LT(nearest, 0.02);
  EXPECT_NEAR(angleBetween(yaw, end.yaw), 0.0, 0.03);
}

TEST(SafestStop, TakesTheWayThatIsFree) {
  const TrajectoryPoint start{2.0, {4.0, 5.0, 0.0}, {1.6, 0.0}};
  const std::vector<TrackedObject> tracks;
  const SampledTrajectory straight = bend(start, 0.0, 1.6);
  TrajectoryPoint turning = start;
  turning.twist.turn_rate = 1.4;
  const SampledTrajectory left = bend(turning, 2.0, 1.6);
  struct Case {
    const SampledTrajectory& committed;
    TrajectoryPoint from;
    SampledTrajectory shut;  // braking that ends with a post under the left front corner
  };
  for (const Case& c : {Case{straight, turning, brakingTrajectory(turning, robotLimits(), kStep)},
                        Case{left, start, brakingAlong(left, start, robotLimits(), kStep)}}) {
    World world(10, 10, false);
    const Eigen::Vector2d post = c.shut.points().back().pose * Eigen::Vector2d(0.37, 0.17);
    world.fill(post.x() - 0.03, post.y() - 0.03, post.x() + 0.03, post.y() + 0.03, true);
    ASSERT_TRUE(world.touches(robotFootprint(), c.shut.points().back().pose));
    const LocalMap map = seenMap(world);
    const ObstacleScan scan;
    TrajectoryValidator validator(robotFootprint(), robotLimits(), 1.5, 0.1);
    validator.observe({map, scan, {}, tracks});
    const SampledTrajectory stop = safestStop(validator, c.committed, c.from, robotLimits(), kStep);
    EXPECT_EQ(motionFlaw(stop.points(), robotLimits()), "");
    for (const TrajectoryPoint& p : stop.points()) EXPECT_FALSE(world.touches(robotFootprint(), p.pose)) << p.time;
  }
}

TEST(SafestStop, IsSlowestWhereItTouches) {
  const TrajectoryPoint start{0.0, {4.0, 5.0, 0.0}, {2.0, 0.0}};
  World world(10, 10, false);
  world.fill(5.0, 0.0, 5.2, 10.0, true);  // nothing helps
  const LocalMap map = seenMap(world);
  const ObstacleScan scan;
  const std::vector<TrackedObject> tracks;
  TrajectoryValidator validator(robotFootprint(), robotLimits(), 1.5, 0.1);
  validator.observe({map, scan, {}, tracks});
  const SampledTrajectory stop = safestStop(validator, {}, start, robotLimits(), kStep);
  EXPECT_NEAR(stop.duration(), 2.0 / robotLimits().acceleration, 2.0 * kStep);
}

TEST(SafestStop, DoesNotGiveUpTheWayPastAWallForOnePastWhatMoves) {
  const TrajectoryPoint start{2.0, {4.0, 5.0, 0.0}, {1.8, 0.0}};
  TrajectoryPoint turning = start;
  turning.twist.turn_rate = 1.2;
  const SampledTrajectory left = bend(turning, 2.0, 1.8);
  World world(10, 10, false);
  world.fill(4.0, 4.0, 6.0, 4.7, true);
  world.fill(5.15, 4.0, 5.3, 5.0, true);  // whoever does not turn runs into this
  const LocalMap map = seenMap(world);
  const ObstacleScan scan;
  TrackedObject robot;  // beside the left turn, going away; its disc reaches into both ways
  robot.stamp = 2.0;
  robot.position = {4.6, 5.95};
  robot.velocity = {0.0, 0.2};
  robot.radius = 0.6;
  robot.moving = robot.has_moved = true;
  const std::vector<TrackedObject> tracks{robot};
  TrajectoryValidator validator(robotFootprint(), robotLimits(), 1.5, 0.1);
  validator.observe({map, scan, {}, tracks});
  const Margins contact{0.01, 0.0, 0.0};
  const SampledTrajectory along = brakingAlong(left, turning, robotLimits(), kStep);
  ASSERT_TRUE(validator.checkObstacles(along.points(), contact).good());
  ASSERT_EQ(validator.checkTracks(along.points()).flaw, Flaw::kTrack);
  const SampledTrajectory stop = safestStop(validator, left, turning, robotLimits(), kStep);
  for (const TrajectoryPoint& p : stop.points()) EXPECT_FALSE(world.touches(robotFootprint(), p.pose)) << p.time;
}

TEST(FreshPieces, AThingByItselfIsOne) {
  const std::vector<FreshPiece> pieces = freshPieces(wall(-0.3, 0.3, 2.0, -1.0, 1.0), 1.2, 0.2);
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_LT((pieces[0].middle - Eigen::Vector2d(0.0, 2.0)).norm(), 0.05);
  EXPECT_NEAR(pieces[0].chord, 0.58, 0.06);
}

TEST(FreshPieces, OldThingsAndWallsAreNone) {
  EXPECT_TRUE(freshPieces(wall(-0.3, 0.3, 2.0, 5.0, 5.0), 1.2, 0.2).empty());     // known
  EXPECT_TRUE(freshPieces(wall(-1.0, 1.0, 2.0, -5.0, 5.0), 1.2, 0.2).empty());    // too long
  EXPECT_TRUE(freshPieces(wall(-1.0, 1.0, 2.0, 0.5, 5.0), 1.2, 0.2).empty());     // goes on after
  EXPECT_TRUE(freshPieces(wall(-1.0, 1.0, 2.0, -5.0, -0.5), 1.2, 0.2).empty());   // and before
  EXPECT_TRUE(freshPieces(wall(-0.03, 0.03, 2.0, -1.0, 1.0), 1.2, 0.2).empty());  // two returns
  EXPECT_TRUE(freshPieces({}, 1.2, 0.2).empty());
}

TEST(FreshPieces, AThingBesideAWallIsOne) {
  std::vector<DatedReturn> returns = wall(-1.0, 0.0, 2.0, 5.0, 5.0);
  for (const DatedReturn& r : wall(0.0, 0.4, 1.4, -5.0, 5.0)) returns.push_back(r);  // half a metre nearer
  EXPECT_EQ(freshPieces(returns, 1.2, 0.2).size(), 1U);
  returns = wall(-1.0, 0.0, 2.0, 5.0, 5.0);
  for (const DatedReturn& r : wall(0.25, 0.65, 2.0, -5.0, 5.0)) returns.push_back(r);  // in line, in an opening
  EXPECT_EQ(freshPieces(returns, 1.2, 0.2).size(), 1U);
  returns = wall(-1.0, 0.0, 2.0, 5.0, 5.0);
  for (double y = 2.0; y > 1.5; y -= 0.03) {  // touching it, at a right angle
    returns.push_back({{0.02, y}, y, true});
  }
  EXPECT_EQ(freshPieces(returns, 1.2, 0.2).size(), 1U);
}

/// A thing at 3 m of which the part right of `hidden_until` [m] is behind a wall at 2 m.
std::vector<DatedReturn> behindACorner(double hidden_until, double width, bool young) {
  std::vector<DatedReturn> returns = wall(-1.0, hidden_until * 2.0 / 3.0, 2.0, 5.0, 5.0);
  for (const DatedReturn& r : wall(hidden_until, hidden_until + width, 3.0, 5.0, 5.0)) {
    returns.push_back(r);
    returns.back().young = young;
  }
  for (std::size_t i = 0; i < returns.size(); ++i) returns[i].bin = static_cast<int>(i);
  return returns;
}

TEST(EmergingPieces, WhatIsHalfHiddenBehindACornerIsOne) {
  const std::vector<FreshPiece> pieces = emergingPieces(behindACorner(0.0, 0.3, true), 1.2, 0.2);
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_LT((pieces[0].middle - Eigen::Vector2d(0.15, 3.0)).norm(), 0.05);
}

TEST(EmergingPieces, OldThingsLongOnesAndThoseInFrontAreNone) {
  EXPECT_TRUE(emergingPieces(behindACorner(0.0, 0.3, false), 1.2, 0.2).empty());
  EXPECT_TRUE(emergingPieces(behindACorner(0.0, 2.0, true), 1.2, 0.2).empty());
  std::vector<DatedReturn> free_standing = wall(-0.3, 0.3, 2.0, 5.0, 5.0);
  for (DatedReturn& r : free_standing) r.young = true;
  EXPECT_TRUE(emergingPieces(free_standing, 1.2, 0.2).empty());
  std::vector<DatedReturn> apart = behindACorner(0.0, 0.3, true);
  for (DatedReturn& r : apart) r.bin += r.young ? 5 : 0;  // free space between it and the corner
  EXPECT_TRUE(emergingPieces(apart, 1.2, 0.2).empty());
  EXPECT_TRUE(emergingPieces({}, 1.2, 0.2).empty());
}

}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

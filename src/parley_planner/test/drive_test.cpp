// SPDX-License-Identifier: BSD-3-Clause
// From path to motion: speed_profile, path_follower, drive_generator, narrow_search, progress_watch, margins.
#include <gtest/gtest.h>

#include <random>

#include "cost_to_go.h"
#include "drive_generator.h"
#include "narrow_search.h"
#include "parley_geometry/polygon.h"
#include "progress_watch.h"
#include "scenes.h"
#include "trajectory_validator.h"

namespace parley {
namespace {

constexpr double kStep = 0.05;  // [s]

ReferencePath line(double length) { return ReferencePath(resampled({{2.0, 5.0}, {2.0 + length, 5.0}}, 0.1)); }

TEST(Margins, SpeedAndClearanceAreInverse) {
  const Margins margins{0.05, 0.04, 0.2};
  EXPECT_EQ(margins.at(0.0), 0.05);
  EXPECT_NEAR(margins.at(-2.0), 0.122, 1e-9);
  EXPECT_EQ(margins.speedFor(0.04), 0.0);
  EXPECT_NEAR(margins.speedFor(margins.at(1.3)), 1.3, 1e-9);
}

TEST(SpeedProfile, BrakesForCurvesAndStops) {
  Path points;
  for (int i = 0; i <= 60; ++i) points.push_back({0.1 * i, 0.0});
  for (int i = 1; i <= 10; ++i) points.push_back(integrateTwist({6.0, 0.0, 0.0}, 1.0, 1.5, 0.1 * i).position());
  SpeedProfile profile(ReferencePath(points), robotLimits());
  profile.lowerBetween(2.0, 2.2, 0.5);
  profile.stopAt(6.5);
  profile.spread();
  EXPECT_NEAR(profile.at(2.1), 0.5, 1e-6);
  EXPECT_NEAR(profile.at(1.5), std::sqrt(0.25 + 2.0 * 2.0 * 0.5), 0.02);
  EXPECT_LT(profile.at(6.3), 1.5708 / 1.5 + 0.01);
  EXPECT_EQ(profile.at(6.6), 0.0);
  for (double s = 0.0; s < 6.4; s += 0.05) EXPECT_LE(profile.at(s), std::sqrt(2.0 * 2.0 * (6.5 - s)) + 1e-9);
}

TEST(PathFollower, DrivesFastAndWithinLimits) {
  const ReferencePath path = line(6.0);
  SpeedProfile profile(path, robotLimits());
  profile.spread();
  const PathDrive drive = followPath(path, profile, {1.0, {2.0, 5.0, 0.0}, {}}, false, robotLimits(), kStep);
  EXPECT_EQ(motionFlaw(drive.points, robotLimits()), "");
  EXPECT_NEAR(drive.points.back().pose.x, 8.0, 0.03);
  EXPECT_LT(drive.points.back().time - 1.0, 4.2);  // 4.0 s is the least
}

TEST(PathFollower, DoesNotStandForLong) {
  // The path asks for speed, the limits allow none: nothing is gained by waiting.
  const ReferencePath path = line(6.0);
  SpeedProfile profile(path, robotLimits());
  profile.spread();
  MotionLimits none = robotLimits();
  none.speed = none.acceleration = 0.0;
  const PathDrive drive = followPath(path, profile, {1.0, {2.0, 5.0, 0.0}, {}}, false, none, kStep);
  EXPECT_LT(drive.points.back().time, 1.5);
}

TEST(PathFollower, RandomStartsObeyLimitsAndConverge) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int i = 0; i < 200; ++i) {
    const ReferencePath path = line(7.0);
    SpeedProfile profile(path, robotLimits());
    profile.lowerBetween(3.0, 4.0, 1.0 + 0.9 * unit(random));
    profile.spread();
    const TrajectoryPoint start{
        0.0, {2.2, 5.0 + 0.15 * unit(random), 0.5 * unit(random)}, {1.0 + 0.8 * unit(random), 0.8 * unit(random)}};
    const PathDrive drive = followPath(path, profile, start, false, robotLimits(), kStep);
    EXPECT_EQ(motionFlaw(drive.points, robotLimits()), "") << "case " << i;
    EXPECT_NEAR(drive.points.back().pose.y, 5.0, 0.02) << "case " << i;
  }
}

TEST(PathFollower, Reverses) {
  const ReferencePath path = line(3.0);
  SpeedProfile profile(path, robotLimits());
  profile.spread();
  const PathDrive drive = followPath(path, profile, {0.0, {2.0, 5.0, -kPi + 0.1}, {}}, true, robotLimits(), kStep);
  EXPECT_EQ(motionFlaw(drive.points, robotLimits()), "");
  EXPECT_NEAR(drive.points.back().pose.x, 5.0, 0.03);
  EXPECT_NEAR(std::abs(drive.points.back().pose.yaw), kPi, 0.02);
  EXPECT_LT(drive.points[10].twist.speed, 0.0);
  // From still rolling forwards.
  const PathDrive rolling = followPath(path, profile, {0.0, {2.0, 5.0, -kPi}, {0.015, 0.0}}, true, robotLimits(), kStep);
  EXPECT_EQ(motionFlaw(rolling.points, robotLimits()), "");
  EXPECT_NEAR(rolling.points.back().pose.x, 5.0, 0.03);
}

TEST(TurnOnSpot, IsExactForAnyAngle) {
  for (const double yaw : {0.001, 0.3, -1.0, 2.9, -3.1}) {
    const auto points = turnOnSpot({3.0, {1.0, 2.0, 0.4}, {}}, wrapAngle(0.4 + yaw), robotLimits(), kStep);
    EXPECT_EQ(motionFlaw(points, robotLimits()), "") << yaw;
    EXPECT_NEAR(angleBetween(points.back().pose.yaw, 0.4 + yaw), 0.0, 1e-9);
    EXPECT_NEAR(points.back().time - 3.0,
                std::abs(yaw) < 0.616 ? 2.0 * std::sqrt(std::abs(yaw) / 4.0) : std::abs(yaw) / 1.5708 + 1.5708 / 4.0, 1e-6);
  }
}

TEST(DriveArc, FollowsTheCircleBothWays) {
  for (const double length : {1.0, -0.6, 0.05}) {
    for (const double curvature : {0.0, 1.7, -1.7}) {
      const auto points = driveArc({0.0, {1.0, 2.0, 0.4}, {}}, curvature, length, 0.5, robotLimits(), kStep);
      EXPECT_EQ(motionFlaw(points, robotLimits()), "");
      const Pose2 end = integrateTwist({1.0, 2.0, 0.4}, length, length * curvature, 1.0);
      EXPECT_NEAR((points.back().pose.position() - end.position()).norm(), 0.0, 1e-6);
    }
  }
}

class GeneratorTest : public testing::Test {
 protected:
  GeneratedDrive generate(const LocalMap& map, const Path& way, const TrajectoryPoint& start,
                          const std::vector<TrackedObject>& tracks = {}) {
    const Surroundings surroundings(map, {}, {}, tracks);
    const ReferencePath path(resampled(way, 0.1));
    return generator_.along(path, start, false, {surroundings, tracks, 1.5, 0.1, {}, 0.08}, {0.05, 0.04, 0.2}, {});
  }
  DriveGenerator generator_{robotFootprint(), robotLimits(), kStep};
};

TEST_F(GeneratorTest, StopsBeforeWalls) {
  World world(10, 10, false);
  world.fill(7.0, 0.0, 7.2, 10.0, true);
  const GeneratedDrive drive = generate(seenMap(world), {{2.0, 5.0}, {8.0, 5.0}}, {0.0, {2.0, 5.0, 0.0}, {1.0, 0.0}});
  EXPECT_EQ(drive.end, DriveEnd::kObstacle);
  EXPECT_EQ(motionFlaw(drive.drive.points, robotLimits()), "");
  EXPECT_LT(drive.drive.points.back().pose.x + 0.4, 6.98);
  EXPECT_GT(drive.drive.points.back().pose.x + 0.4, 6.80);
}

TEST_F(GeneratorTest, StopsBeforeTheUnseen) {
  LocalMap map = seenMap(World(10, 10, false));
  setCells(&map, 6.0, 0.0, 10.0, 10.0, CellState::kUnknown);
  const GeneratedDrive drive = generate(map, {{2.0, 5.0}, {8.0, 5.0}}, {0.0, {2.0, 5.0, 0.0}, {}});
  EXPECT_EQ(drive.end, DriveEnd::kUnseen);
  EXPECT_LE(drive.drive.points.back().pose.x + 0.4, 6.03);
  EXPECT_GT(drive.advance, 3.4);
}

TEST_F(GeneratorTest, SlowsDownWhereItIsNarrow) {
  World world(10, 10, false);
  world.fill(4.0, 0.0, 5.0, 4.7, true);
  world.fill(4.0, 5.3, 5.0, 10.0, true);
  const GeneratedDrive drive = generate(seenMap(world), {{2.0, 5.0}, {8.0, 5.0}}, {0.0, {2.0, 5.0, 0.0}, {}});
  EXPECT_EQ(drive.end, DriveEnd::kPathEnd);
  double fastest = 0.0;
  for (const TrajectoryPoint& p : drive.drive.points) {
    if (p.pose.x > 3.8 && p.pose.x < 5.2) fastest = std::max(fastest, p.twist.speed);
  }
  EXPECT_LT(fastest, 1.95);
}

TEST_F(GeneratorTest, StopsForWhatWillCross) {
  TrackedObject track;
  track.position = {5.0, 7.0};
  track.velocity = {0.0, -1.5};
  track.radius = 0.3;
  track.moving = track.has_moved = true;
  const LocalMap map = seenMap(World(10, 10, false));
  const TrajectoryPoint start{0.0, {3.0, 5.0, 0.0}, {1.5, 0.0}};
  EXPECT_EQ(generate(map, {{3.0, 5.0}, {8.0, 5.0}}, start, {track}).end, DriveEnd::kTrack);
  track.moving = track.has_moved = false;
  EXPECT_EQ(generate(map, {{3.0, 5.0}, {8.0, 5.0}}, start, {track}).end, DriveEnd::kPathEnd);
}

TEST_F(GeneratorTest, SaysWhenItCannotStopAnyMore) {
  World world(10, 10, false);
  world.fill(3.0, 0.0, 3.2, 10.0, true);
  const GeneratedDrive drive = generate(seenMap(world), {{2.0, 5.0}, {8.0, 5.0}}, {0.0, {2.0, 5.0, 0.0}, {2.0, 0.0}});
  EXPECT_EQ(drive.end, DriveEnd::kInfeasible);
}

TEST_F(GeneratorTest, TurnsOnlyWhereItsCornersPass) {
  World world(10, 10, false);
  world.fill(5.25, 5.25, 5.35, 5.35, true);  // in the way of the left front corner
  const Surroundings surroundings(seenMap(world), {}, {}, {});
  const std::vector<TrackedObject> tracks;
  const DriveScene scene{surroundings, tracks, 1.5, 0.1, {}, 0.08};
  const TrajectoryPoint start{0.0, {5.0, 5.0, 0.0}, {}};
  EXPECT_TRUE(generator_.turn(start, 1.6, scene, {0.02, 0.04, 0.2}).empty());
  EXPECT_FALSE(generator_.turn(start, -0.8, scene, {0.02, 0.04, 0.2}).empty());
}

TEST(NarrowSearch, TurnsBeforeItEnters) {
  // A slot 0.6 m wide leads up from a chamber in which the robot stands across.
  World world(10, 10, true);
  world.fill(4.0, 4.0, 6.0, 5.1, false);
  world.fill(4.7, 5.0, 5.3, 9.0, false);
  const Surroundings surroundings(seenMap(world), {}, {}, {});
  const FootprintProbe probe(robotFootprint());
  const TrajectoryPoint start{0.0, {4.6, 4.5, 0.0}, {}};
  const auto points = searchNarrow(start, {5.0, 7.5}, surroundings, probe, robotLimits(), kStep, {40000, 0.04, 0.5});
  ASSERT_FALSE(points.empty());
  EXPECT_EQ(motionFlaw(points, robotLimits()), "");
  EXPECT_LT((points.back().pose.position() - Eigen::Vector2d(5.0, 7.5)).norm(), kTargetRadius + 0.01);
  for (const TrajectoryPoint& p : points) EXPECT_FALSE(world.touches(robotFootprint(), p.pose));
  EXPECT_TRUE(searchNarrow(start, {1.0, 1.0}, surroundings, probe, robotLimits(), kStep, {40000, 0.04, 0.5}).empty());
  EXPECT_TRUE(searchNarrow(start, {5.0, 7.5}, surroundings, probe, robotLimits(), kStep, {2, 0.04, 0.5}).empty());
}

TEST(NarrowSearch, TurnsBesideAnotherThatStands) {
  // Across a corridor, with a teammate nearer than should be on one side: first away from it.
  World world(10, 10, true);
  world.fill(0.5, 4.4, 9.5, 5.6, false);
  const Surroundings walls(seenMap(world), {}, {}, {});
  const Footprint footprint = robotFootprint();
  Blocked blocked;
  blocked.bodies = {{{5.865, 4.985, 0.0}, footprint, 0.1}};
  const Surroundings with_them = walls.with(blocked);
  const TrajectoryPoint start{0.0, {5.0, 5.1, -0.92}, {}};
  const double gap = convexDistance(footprint.polygonAt(start.pose), footprint.polygonAt(blocked.bodies[0].pose));
  ASSERT_LT(gap, 0.08);
  NarrowSearchOptions options{40000, 0.05, 0.5, blocked.bodies, &with_them};
  const auto points = searchNarrow(start, {3.0, 5.0}, walls, FootprintProbe(footprint), robotLimits(), kStep, options);
  ASSERT_FALSE(points.empty());
  for (const TrajectoryPoint& p : points) {
    EXPECT_FALSE(world.touches(footprint, p.pose));
    EXPECT_GT(convexDistance(footprint.polygonAt(p.pose), footprint.polygonAt(blocked.bodies[0].pose)), gap - 0.015);
  }
  // Past it there is no way.
  EXPECT_TRUE(searchNarrow(start, {8.0, 5.0}, walls, FootprintProbe(footprint), robotLimits(), kStep, options).empty());
}

TEST(NarrowSearch, ComesOffAWallAlongWhichItStands) {
  World world(12, 10, true);
  world.fill(0.5, 4.2, 11.5, 5.8, false);
  const Surroundings surroundings(seenMap(world), {}, {}, {});
  for (const double gap : {0.015, 0.03, 0.045}) {
    for (const double yaw : {0.0, kPi}) {
      const TrajectoryPoint start{0.0, {5.0, 5.6 - gap, yaw}, {}};
      const auto points = searchNarrow(start, {7.5, 5.1}, surroundings, FootprintProbe(robotFootprint()), robotLimits(), kStep,
                                       {20000, 0.03, 0.5});
      ASSERT_FALSE(points.empty()) << gap;
      EXPECT_LT((points.back().pose.position() - Eigen::Vector2d(7.5, 5.1)).norm(), kTargetRadius + 0.01);
      for (const TrajectoryPoint& p : points) EXPECT_FALSE(world.touches(robotFootprint(), p.pose)) << gap;
    }
  }
}

TEST(NarrowSearch, ArcsAreWithinTheLimitsToTheLastBit) {
  const World world(10, 10, false);
  const LocalMap map = seenMap(world);
  const std::vector<TrackedObject> tracks;
  const ObstacleScan scan;
  TrajectoryValidator validator(robotFootprint(), robotLimits(), 1.5, 0.1);
  validator.observe({map, scan, {}, tracks});
  std::mt19937 random(4);
  std::uniform_real_distribution<double> length(0.05, 3.0), curvature(-2.0, 2.0);
  for (int i = 0; i < 300; ++i) {
    const TrajectoryPoint start{1.0, {5.0, 5.0, 0.3}, {}};
    const double way = (i % 2 ? 1.0 : -1.0) * length(random), bend = i % 3 ? curvature(random) : 0.0;
    const SampledTrajectory arc(driveArc(start, bend, way, 0.5, robotLimits(), kStep));
    const Verdict verdict = validator.check(arc, start, {0.02, 0.02, 0.2});
    EXPECT_EQ(verdict.flaw, Flaw::kNone) << way << " m, curvature " << bend << " at " << verdict.time;
    EXPECT_NEAR(arc.length(), std::abs(way), 0.01);
  }
}

TEST(CostToGo, IsNeverMoreThanTheWay) {
  World world(10, 10, false);
  world.fill(4.0, 0.0, 4.2, 8.0, true);  // a wall with a way round its upper end
  const Surroundings surroundings(seenMap(world), {}, {}, {});
  const CostToGo guide(surroundings, {6.0, 2.0}, 0.2, 20.0);
  const double round = std::hypot(2.0, 6.2) + std::hypot(2.0, 6.2);
  EXPECT_LT(guide.at({2.0, 2.0}), round + 0.5);
  EXPECT_GT(guide.at({2.0, 2.0}), 0.85 * round);
  EXPECT_LT(guide.at({7.0, 2.0}), 1.0);
  EXPECT_TRUE(std::isinf(guide.at({4.1, 2.0})));
  EXPECT_TRUE(std::isinf(guide.at({50.0, 2.0})));
  EXPECT_TRUE(std::isinf(CostToGo(surroundings, {6.0, 2.0}, 0.2, 3.0).at({2.0, 2.0})));
  EXPECT_TRUE(std::isinf(CostToGo(surroundings, {60.0, 2.0}, 0.2, 3.0).at({2.0, 2.0})));
}

TEST(ProgressWatch, CountsTimeInOnePlace) {
  ProgressWatch watch(2.0);
  EXPECT_EQ(watch.update({0.0, 0.0}, 0.0), 0);
  EXPECT_EQ(watch.update({0.1, 0.0}, 2.1), 1);
  EXPECT_EQ(watch.update({0.6, 0.0}, 2.5), 1);  // got on a little: the measure is kept
  EXPECT_EQ(watch.update({0.2, 0.0}, 4.5), 2);
  EXPECT_EQ(watch.update({1.2, 0.0}, 5.0), 0);
  EXPECT_EQ(watch.update({1.7, 0.0}, 6.9), 0);
  watch.reset();
  EXPECT_EQ(watch.level(), 0);
}

}  // namespace
}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

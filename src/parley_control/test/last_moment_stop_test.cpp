// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <random>

#include "closed_loop.h"

namespace parley {
namespace {

using testing::clearance;
using testing::ClosedLoop;
using testing::trajectoryOf;
using testing::trapezoid;
using testing::Wall;

SampledTrajectory straight(const Pose2& start, double start_time, double speed, double duration = 10.0) {
  return trajectoryOf(start, start_time, duration, [=](double t) { return Twist2{speed * trapezoid(t, duration, 1.0), 0.0}; });
}

/// Steps until `time`, [s]; the least distance from the walls on the way.
double run(ClosedLoop& loop, const SampledTrajectory& trajectory, double time) {
  double least = std::numeric_limits<double>::infinity();
  while (loop.now < time) {
    loop.step(trajectory);
    least = std::min(least, clearance(loop.walls, loop.drive.pose));
  }
  return least;
}

/// A wall across the robot's way, `distance` [m] before its front (behind its back if `sign` is -1), seen at once.
void dropWall(ClosedLoop& loop, double distance, double sign, double tilt) {
  const Pose2 foot = loop.drive.pose * Pose2{sign * (0.4 + distance + 0.2 * std::abs(std::tan(tilt))), 0.0, tilt};
  loop.walls = {{foot * Eigen::Vector2d(0.0, -3.0), foot * Eigen::Vector2d(0.0, 3.0)}};
  loop.look();
}

TEST(LastMomentStop, stopsBeforeAWallThatIsSuddenlyThere) {
  for (const double sign : {1.0, -1.0}) {
    for (const double tilt : {0.0, 0.5, -0.8}) {
      for (const double distance : {1.03, 1.1, 1.3, 2.0}) {  // 1 m is the braking distance from 2 m/s
        ClosedLoop loop;
        const auto trajectory = straight({0.0, 0.0, 0.7}, loop.now, sign * 2.0);
        run(loop, trajectory, 103.0);
        ASSERT_NEAR(loop.drive.twist.speed, sign * 2.0, 0.01);
        dropWall(loop, distance, sign, tilt);
        EXPECT_GT(run(loop, trajectory, 104.5), 0.0) << sign << " " << tilt << " " << distance;
        EXPECT_EQ(loop.drive.twist.speed, 0.0);
      }
    }
  }
}

TEST(LastMomentStop, brakesAtTheLimitEvenWhenItIsTooLate) {
  ClosedLoop loop;
  const auto trajectory = straight({}, loop.now, 2.0);
  run(loop, trajectory, 103.0);
  dropWall(loop, 0.5, 1.0, 0.0);
  for (int i = 1; i <= 20; ++i) {
    const ControlResult result = loop.step(trajectory);
    EXPECT_TRUE(result.emergency);
    EXPECT_EQ(result.state, DriveState::kBlocked);
    EXPECT_EQ(result.reason, "obstacle in the braking path");
    EXPECT_NEAR(result.twist.speed, 2.0 - i * 0.04, 0.01);
  }
}

TEST(LastMomentStop, anythingCountsThatTheLidarSees) {
  ClosedLoop loop;
  const auto trajectory = straight({}, loop.now, 2.0);
  run(loop, trajectory, 103.0);
  dropWall(loop, 1.1, 1.0, 0.0);
  loop.scan.transient.assign(loop.scan.ranges.size(), true);
  EXPECT_TRUE(loop.step(trajectory).emergency);
}

TEST(LastMomentStop, driveAlongAWallIsNotStopped) {
  for (const double side : {0.05, 0.04, 0.02}) {
    for (const double speed : {0.2, 1.0, -0.5}) {
      ClosedLoop loop;
      loop.walls = {{{-20.0, 0.2 + side}, {20.0, 0.2 + side}}, {{-20.0, -0.2 - side}, {20.0, -0.2 - side}}};
      const auto trajectory = straight({}, loop.now, speed);
      while (loop.now < 110.5) ASSERT_FALSE(loop.step(trajectory).emergency) << side << " " << speed << " " << loop.now;
      EXPECT_NEAR(loop.drive.pose.x, trajectory.points().back().pose.x, 0.03);
    }
  }
}

TEST(LastMomentStop, noiseInATightPlaceDoesNotStopACreepingRobot) {
  std::mt19937 random(3);
  std::normal_distribution<float> noise(0.0F, 0.004F);
  ClosedLoop loop;
  loop.walls = {{{-20.0, 0.25}, {20.0, 0.25}}, {{-20.0, -0.25}, {20.0, -0.25}}};
  loop.scan_is_held = true;
  const auto trajectory = straight({}, loop.now, 0.2, 20.0);
  int stops = 0;
  for (int i = 0; i < 1000; ++i) {
    if (i % 5 == 0) loop.look();
    if (i % 5 == 0) std::for_each(loop.scan.ranges.begin(), loop.scan.ranges.end(), [&](float& r) { r += noise(random); });
    stops += loop.step(trajectory).emergency ? 1 : 0;
  }
  EXPECT_EQ(stops, 0);
}

TEST(LastMomentStop, aRobotInsideTheMarginMayLeaveButNotGoOn) {
  const std::vector<Wall> wall{{{0.42, -3.0}, {0.42, 3.0}}};
  for (const double speed : {-0.5, 0.5}) {
    ClosedLoop loop;
    loop.walls = wall;
    const double least = run(loop, straight({}, loop.now, speed, 3.0), 103.0);
    EXPECT_GE(least, 0.01);
    if (speed < 0.0) {
      EXPECT_LT(loop.drive.pose.x, -0.5);
    }
    if (speed > 0.0) {
      EXPECT_LT(loop.drive.pose.x, 0.015);
    }
  }
}

TEST(LastMomentStop, aRobotInsideTheMarginMayTurnAway) {
  // The front left corner is 2 cm from a wall that leans outwards: turning right takes it away, turning left into it.
  const std::vector<Wall> wall{{{0.40, 0.22}, {1.40, 1.22}}};
  for (const double turn : {-1.0, 1.0}) {
    ClosedLoop loop;
    loop.walls = wall;
    const auto trajectory = trajectoryOf({}, loop.now, 2.0, [=](double t) {
      return Twist2{0.0, 0.5 * turn * trapezoid(t, 2.0, 0.5)};
    });
    EXPECT_GT(run(loop, trajectory, 103.0), 0.005) << turn;
    if (turn < 0.0) {
      EXPECT_LT(loop.drive.pose.yaw, -0.6);
    }
    if (turn > 0.0) {
      EXPECT_LT(loop.drive.pose.yaw, 0.1);
    }
  }
}

TEST(LastMomentStop, aPlannedStopCloseToAWallIsLeftAlone) {
  for (const double braking_time : {1.0, 1.2, 2.0}) {  // [s] from 2 m/s; the first is as hard as the robot can
    ClosedLoop loop;
    const auto trajectory = trajectoryOf({}, loop.now, 6.0, [=](double t) {
      return Twist2{2.0 * std::clamp(std::min(t, (6.0 - t) / braking_time), 0.0, 1.0), 0.0};
    });
    const double front = trajectory.points().back().pose.x + 0.4;
    loop.walls = {{{front + 0.1, -3.0}, {front + 0.1, 3.0}}};
    while (loop.now < 107.0) ASSERT_FALSE(loop.step(trajectory).emergency) << braking_time << " at " << loop.now;
  }
}

TEST(LastMomentStop, aBendAroundObstaclesIsLeftAlone) {
  ClosedLoop loop;
  const auto trajectory = trajectoryOf({}, loop.now, 10.0, [](double t) {
    return Twist2{1.6 * trapezoid(t, 10.0, 1.0), 1.0 * std::sin(t * kPi / 1.2) * trapezoid(t, 10.0, 1.0)};
  });
  for (std::size_t i = 1; i < trajectory.points().size(); ++i) {  // a corridor that bends with the path, 1 m wide
    const Pose2 &a = trajectory.points()[i - 1].pose, &b = trajectory.points()[i].pose;
    for (const double y : {-0.5, 0.5}) loop.walls.push_back({a * Eigen::Vector2d(0.0, y), b * Eigen::Vector2d(0.0, y)});
  }
  while (loop.now < 111.0) ASSERT_FALSE(loop.step(trajectory).emergency) << loop.now;
}

TEST(LastMomentStop, holdsAndThenDrivesOnWhenTheWayIsClear) {
  ClosedLoop loop;
  auto trajectory = straight({}, loop.now, 1.0);
  run(loop, trajectory, 102.0);
  dropWall(loop, 0.28, 1.0, 0.0);
  run(loop, trajectory, 103.0);
  EXPECT_EQ(loop.drive.twist.speed, 0.0);
  loop.walls.clear();
  trajectory = straight(loop.drive.pose, loop.now, 1.0);
  run(loop, trajectory, 103.2);
  EXPECT_EQ(loop.drive.twist.speed, 0.0) << "let go too early";
  run(loop, trajectory, 104.0);
  EXPECT_GT(loop.drive.twist.speed, 0.8);
  dropWall(loop, 0.26, 1.0, 0.0);
  EXPECT_TRUE(loop.step(trajectory).emergency) << "must brake again";
}

TEST(LastMomentStop, doesNotStutterUpToAWallThatThePlannerDoesNotSee) {
  ClosedLoop loop;
  loop.walls = {{{6.0, -3.0}, {6.0, 3.0}}};
  int onsets = 0;
  bool before = false;
  for (int i = 0; i < 750; ++i) {
    const ControlResult result = loop.step(straight(loop.drive.pose, loop.now - 0.6, 1.5));
    onsets += result.emergency && !before ? 1 : 0;
    before = result.emergency;
    ASSERT_GT(clearance(loop.walls, loop.drive.pose), 0.0);
  }
  EXPECT_LE(onsets, 12);
}

/// Seven boxes, none within 0.1 m of a robot at the origin. Boxes, for a lidar does not see a line from its end.
std::vector<Wall> randomWalls(std::mt19937& random) {
  std::uniform_real_distribution<double> coordinate(-4.0, 4.0), length(0.1, 3.0), angle(-kPi, kPi);
  std::vector<Wall> walls;
  while (walls.size() < 28) {
    const Pose2 middle{coordinate(random), coordinate(random), angle(random)};
    const Polygon box = Footprint{length(random), 0.15}.polygonAt(middle);
    if (convexDistance(box, testing::footprint().polygon()) < 0.1) continue;
    for (std::size_t i = 0; i < 4; ++i) walls.push_back({box[i], box[(i + 1) % 4]});
  }
  return walls;
}

/// Two seconds and more of motion that knows nothing of the walls: smooth, or in jerks that no drive can follow.
SampledTrajectory randomPlan(std::mt19937& random, const Pose2& start, double start_time) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const double speed = 2.0 * unit(random), turn_rate = 1.5 * unit(random);
  if (unit(random) > 0.0) {
    return trajectoryOf(start, start_time, 3.0, [=](double t) {
      return Twist2{speed * trapezoid(t, 3.0, 1.0), turn_rate * trapezoid(t, 3.0, 0.6)};
    });
  }
  std::vector<Twist2> jerks(8);
  for (Twist2& twist : jerks) twist = {speed + 0.5 * unit(random), 2.0 * unit(random)};
  return trajectoryOf(start, start_time, 3.0, [=](double t) { return jerks[std::min<std::size_t>(7, t / 0.4)]; });
}

/// Drives random plans among random walls, where what `fail` does goes wrong in the middle of each; steps in emergency.
int driveBlindly(unsigned seed, const std::function<void(ClosedLoop&, bool)>& fail, std::size_t delay_steps = 0) {
  std::mt19937 random(seed);
  ControlOptions options;
  options.look_ahead += static_cast<double>(delay_steps) * ClosedLoop::kPeriod;
  ClosedLoop loop(options);
  loop.delay_steps = delay_steps;
  loop.walls = randomWalls(random);
  int stops = 0;
  for (int plan = 0; plan < 6; ++plan) {
    const auto trajectory = randomPlan(random, loop.drive.pose, loop.now);
    const int failure = std::uniform_int_distribution<int>(20, 80)(random);
    for (int i = 0; i < 150; ++i) {
      fail(loop, i >= failure);
      stops += loop.step(trajectory).emergency ? 1 : 0;
      if (clearance(loop.walls, loop.drive.pose) > 0.0) continue;
      ADD_FAILURE() << "touched: seed " << seed << " plan " << plan << " step " << i << " failure " << failure;
      return stops;
    }
  }
  return stops;
}

TEST(LastMomentStop, neverTouchesAnythingStaticWhateverThePlanIs) {
  int stops = 0;
  for (unsigned seed = 0; seed < 30; ++seed) stops += driveBlindly(seed, [](ClosedLoop&, bool) {});
  EXPECT_GT(stops, 300) << "the walls must matter";
}

TEST(LastMomentStop, neverTouchesAnythingStaticWhateverFails) {
  for (unsigned seed = 0; seed < 8; ++seed) {
    driveBlindly(seed, [](ClosedLoop& loop, bool failed) { loop.planner_is_silent = failed; });
    driveBlindly(seed, [](ClosedLoop& loop, bool failed) { loop.odometry_is_held = failed; });
    driveBlindly(seed, [](ClosedLoop& loop, bool failed) { loop.scan_is_held = failed; });
    driveBlindly(
        seed, [](ClosedLoop&, bool) {}, 3);
  }
}

}  // namespace
}  // namespace parley

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

// SPDX-License-Identifier: BSD-3-Clause
#include "parley_robot/robot_stack.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "test_world.h"

namespace parley {
namespace {

using test::box;
using test::IdealDrive;
using test::Wall;

RobotOptions robotOptions() {
  RobotOptions options;
  options.name = "robot";
  options.footprint = {0.8, 0.4};
  options.limits = {2.0, 1.5708, 2.0, 4.0};
  return options;
}

/// One robot in a world of walls, in lockstep at 50 Hz.
class RobotInWorld {
 public:
  explicit RobotInWorld(std::vector<Wall> walls, const RobotOptions& options = robotOptions())
      : walls_(std::move(walls)), options_(options), stack_(options) {}

  RobotOutput step() {
    time_ += 0.02;
    if (odometry_on) stack_.addOdometry({time_, offset * drive_.pose, drive_.twist, 0.0, 0.0});
    if (lidar_on && ++count_ % 5 == 0) stack_.addScan(test::scanFrom(walls_, drive_.pose, time_));
    const RobotOutput output = stack_.step(time_);
    drive_.step(output.twist, options_.limits, 0.02);
    for (const Wall& wall : walls_) touched_ = touched_ || touches(wall);
    return output;
  }

  RobotOutput run(double seconds) {
    RobotOutput output;
    for (double end = time_ + seconds; time_ < end && output.state != DriveState::kArrived;) output = step();
    return output;
  }

  bool odometry_on = true;
  bool lidar_on = true;
  Pose2 offset;

  RobotStack& stack() { return stack_; }
  const IdealDrive& drive() const { return drive_; }
  bool touched() const { return touched_; }
  double& time() { return time_; }

 private:
  bool touches(const Wall& wall) const {
    const Polygon body = options_.footprint.polygonAt(drive_.pose);
    for (std::size_t i = 0; i < body.size(); ++i) {
      if (segmentsIntersect(body[i], body[(i + 1) % body.size()], wall.a, wall.b)) return true;
    }
    return false;
  }

  std::vector<Wall> walls_;
  RobotOptions options_;
  RobotStack stack_;
  IdealDrive drive_;
  double time_ = 0.0;
  int count_ = 0;
  bool touched_ = false;
};

std::vector<Wall> roomWithBox() {
  std::vector<Wall> walls = box(-2.0, -4.0, 10.0, 4.0);
  for (const Wall& wall : box(3.0, -1.5, 4.0, 1.5)) walls.push_back(wall);
  return walls;
}

TEST(RobotStack, DrivesAroundABoxToItsGoal) {
  RobotInWorld world(roomWithBox());
  ASSERT_TRUE(world.stack().setGoal({8.0, 0.0}));
  const RobotOutput end = world.run(40.0);
  EXPECT_EQ(end.state, DriveState::kArrived) << end.reason;
  EXPECT_LT((world.drive().pose.position() - Eigen::Vector2d(8.0, 0.0)).norm(), 0.3);
  EXPECT_FALSE(world.touched());
  EXPECT_GT(end.replans, 0);
}

/// A disc of the robot's width gets through a gap and round the box behind it, its rectangle does not: the other door is 5 m off.
TEST(RobotStack, GivesUpAPassageThatIsTooTightToTurnIn) {
  std::vector<Wall> walls = box(-2.0, -4.0, 10.0, 6.0);
  for (const auto& [low, high] : {std::pair{-4.0, -0.3}, {0.3, 4.0}, {5.2, 6.0}}) {
    for (const Wall& wall : box(3.9, low, 4.0, high)) walls.push_back(wall);
  }
  for (const Wall& wall : box(4.57, -1.2, 5.1, 1.2)) walls.push_back(wall);
  RobotInWorld world(walls);
  ASSERT_TRUE(world.stack().setGoal({8.0, 0.0}));
  const RobotOutput end = world.run(60.0);
  EXPECT_EQ(end.state, DriveState::kArrived) << end.reason;
  EXPECT_FALSE(world.touched());
}

TEST(RobotStack, ReactiveVariantDrivesStraightWhereItCan) {
  RobotOptions options = robotOptions();
  options.variant = Variant::kReactive;
  RobotInWorld world(box(-2.0, -4.0, 10.0, 4.0), options);
  world.stack().setGoal({8.0, 0.0});
  EXPECT_EQ(world.run(20.0).state, DriveState::kArrived);
  EXPECT_FALSE(world.touched());
}

TEST(RobotStack, SameInputsGiveTheSameBits) {
  RobotInWorld a(roomWithBox()), b(roomWithBox());
  a.stack().setGoal({8.0, 1.0});
  b.stack().setGoal({8.0, 1.0});
  for (int i = 0; i < 500; ++i) {
    a.step();
    b.step();
    ASSERT_TRUE(a.drive().pose == b.drive().pose) << "step " << i;
  }
}

TEST(RobotStack, StandsWithoutGoalWithoutOdometryAndWithoutLidar) {
  RobotInWorld idle(roomWithBox());
  EXPECT_EQ(idle.run(1.0).state, DriveState::kStopped);
  EXPECT_FALSE(idle.stack().setGoal({std::nan(""), 0.0}));

  RobotInWorld no_odometry(roomWithBox());
  no_odometry.odometry_on = false;
  no_odometry.stack().setGoal({8.0, 0.0});
  EXPECT_EQ(no_odometry.run(2.0).state, DriveState::kNoOdometry);

  RobotInWorld no_lidar(roomWithBox());
  no_lidar.lidar_on = false;
  no_lidar.stack().setGoal({8.0, 0.0});
  EXPECT_EQ(no_lidar.run(2.0).state, DriveState::kNoLidar);
  EXPECT_EQ(no_lidar.drive().pose.x, 0.0);
}

TEST(RobotStack, LosingTheLidarOnTheWayStopsItAndGettingItBackGoesOn) {
  RobotInWorld world(roomWithBox());
  world.stack().setGoal({8.0, 0.0});
  world.run(2.0);
  EXPECT_GT(world.drive().twist.speed, 0.3);
  world.lidar_on = false;
  EXPECT_EQ(world.run(3.0).state, DriveState::kNoLidar);
  EXPECT_EQ(world.drive().twist.speed, 0.0);
  world.lidar_on = true;
  EXPECT_EQ(world.run(40.0).state, DriveState::kArrived);
  EXPECT_FALSE(world.touched());
}

TEST(RobotStack, OdometryJumpDropsTheMapAndIsCounted) {
  RobotInWorld world(roomWithBox());
  world.stack().setGoal({8.0, 0.0});
  world.run(2.0);
  world.offset = {0.0, 30.0, 0.0};
  world.run(0.1);
  EXPECT_EQ(world.stack().counters().odometry_jumps, 1);
  world.stack().setGoal({8.0, 30.0});
  EXPECT_EQ(world.run(40.0).state, DriveState::kArrived);
  EXPECT_FALSE(world.touched());
}

TEST(RobotStack, OdometryIsCorrectedAndItDrivesOn) {
  for (const Pose2& correction : {Pose2{0.3, 0.0, 0.052}, Pose2{-0.2, 0.22, -0.052}, Pose2{0.0, -0.3, 0.052}}) {
    RobotInWorld world(roomWithBox());
    world.stack().setGoal({8.0, 0.0});
    world.run(2.0);
    const double speed = world.drive().twist.speed;
    ASSERT_GT(speed, 0.3);
    const std::size_t contours = world.stack().topology().contours().size();
    world.offset = world.drive().pose * correction * world.drive().pose.inverse();
    const Pose2 before = world.stack().odometry().latest().pose;
    world.step();
    EXPECT_EQ(world.stack().counters().odometry_corrections, 1);
    EXPECT_LT((world.stack().odometry().latest().pose.position() - before.position()).norm(), 0.05) << "inside nothing jumps";
    EXPECT_EQ(world.stack().topology().contours().size(), contours);
    for (int i = 0; i < 25; ++i) {
      EXPECT_EQ(world.step().state, DriveState::kDriving);
      EXPECT_GT(world.drive().twist.speed, 0.5 * speed);
    }
    EXPECT_EQ(world.run(40.0).state, DriveState::kArrived);
    EXPECT_LT(((world.offset * world.drive().pose).position() - Eigen::Vector2d(8.0, 0.0)).norm(), 0.3);
    EXPECT_FALSE(world.touched());
    EXPECT_EQ(world.stack().counters().odometry_jumps, 0);
    // A goal that is given now is in the corrected frame too.
    world.stack().setGoal({0.0, 0.0});
    for (int i = 0; i < 25; ++i) world.step();
    EXPECT_EQ(world.run(40.0).state, DriveState::kArrived);
    EXPECT_LT((world.offset * world.drive().pose).position().norm(), 0.3);
  }
}

TEST(RobotStack, TimeGoingBackStartsAnew) {
  RobotInWorld world(roomWithBox());
  world.stack().setGoal({8.0, 0.0});
  world.run(5.0);
  world.time() = 0.0;
  world.step();
  EXPECT_EQ(world.stack().counters().time_resets, 1);
  EXPECT_EQ(world.run(40.0).state, DriveState::kArrived);
  EXPECT_FALSE(world.touched());
}

TEST(RobotStack, HostileReadingsAreDroppedAndCounted) {
  RobotInWorld world(roomWithBox());
  world.stack().setGoal({8.0, 0.0});
  world.run(1.0);
  world.stack().addOdometry({world.time() + 0.01, {std::nan(""), 0.0, 0.0}, {}, 0.0, 0.0});
  EXPECT_EQ(world.stack().counters().odometry_rejected, 1);
  RangeScan bad;
  bad.stamp = world.time();
  world.stack().addScan(bad);
  world.stack().step(world.time());
  LidarCloud empty;
  empty.stamp = world.time();
  world.stack().addCloud(empty);
  world.stack().step(world.time());
  EXPECT_EQ(world.stack().counters().scans_rejected, 2);
  EXPECT_EQ(world.run(40.0).state, DriveState::kArrived);
}

TEST(RobotStack, CancellingTheGoalStops) {
  RobotInWorld world(roomWithBox());
  world.stack().setGoal({8.0, 0.0});
  world.run(2.0);
  world.stack().cancelGoal();
  EXPECT_EQ(world.run(2.0).state, DriveState::kStopped);
  EXPECT_EQ(world.drive().twist.speed, 0.0);
}

TEST(RobotStack, GoalBehindWallsIsReportedAsNoRoute) {
  std::vector<Wall> walls = box(-2.0, -4.0, 10.0, 4.0);
  for (const Wall& wall : box(5.0, -1.5, 8.0, 1.5)) walls.push_back(wall);
  RobotInWorld world(walls);
  world.stack().setGoal({6.5, 0.0});
  EXPECT_EQ(world.run(60.0).state, DriveState::kNoRoute);
  EXPECT_FALSE(world.touched());
}

TEST(RobotStack, UnusableOptionsThrowWithAllProblems) {
  RobotOptions options = robotOptions();
  options.footprint.length = 0.0;
  options.wiring.plan_rate = -1.0;
  try {
    const RobotStack stack(options);
    FAIL() << "must throw";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("length"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("plan_rate"), std::string::npos);
  }
}

}  // namespace
}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

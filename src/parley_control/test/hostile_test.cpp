// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <random>

#include "closed_loop.h"

namespace parley {
namespace {

using testing::ClosedLoop;
using testing::limits;
using testing::trajectoryOf;

/// Now and then something that no sensor should ever say.
double spoiled(std::mt19937& random, double value, double share) {
  constexpr double kBad[] = {std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::infinity(),
                             -std::numeric_limits<double>::infinity(),
                             1e300,
                             -1e300,
                             1e9,
                             0.0,
                             1e-308};
  if (std::uniform_real_distribution<double>(0.0, 1.0)(random) > share) return value;
  return kBad[std::uniform_int_distribution<std::size_t>(0, std::size(kBad) - 1)(random)];
}

Pose2 spoiled(std::mt19937& random, const Pose2& p, double share) {
  return {spoiled(random, p.x, share), spoiled(random, p.y, share), spoiled(random, p.yaw, share)};
}

SampledTrajectory spoiledTrajectory(std::mt19937& random, const Pose2& start, double start_time) {
  std::vector<TrajectoryPoint> points;
  for (int i = 0; i < 20; ++i) {
    const Twist2 twist{spoiled(random, 1.0, 0.02), spoiled(random, 0.3, 0.02)};
    points.push_back({start_time + 0.1 * i, spoiled(random, integrateTwist(start, 1.0, 0.3, 0.1 * i), 0.02), twist});
  }
  return SampledTrajectory(std::move(points));
}

ObstacleScan spoiledScan(std::mt19937& random, double stamp) {
  ObstacleScan scan;
  scan.stamp = spoiled(random, stamp, 0.02);
  scan.origin = {spoiled(random, 0.1, 0.02), spoiled(random, 0.0, 0.02)};
  scan.ranges.resize(std::uniform_int_distribution<std::size_t>(0, 5)(random) == 0 ? 1 : 720);
  for (float& range : scan.ranges) range = static_cast<float>(spoiled(random, 3.0, 0.1));
  return scan;
}

TEST(Hostile, whateverComesInOnlySoundTwistsComeOut) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    std::mt19937 random(seed);
    Controller controller(ControlOptions{}, testing::footprint(), limits());
    double now = 50.0;
    for (int i = 0; i < 300; ++i) {
      now += 0.02;
      const Pose2 pose{now, -now, 0.1 * now};
      const Odometry odometry{spoiled(random, now, 0.02),
                              spoiled(random, pose, 0.02),
                              {spoiled(random, 1.0, 0.02), spoiled(random, 0.1, 0.02)},
                              0.0,
                              0.0};
      const SampledTrajectory trajectory = spoiledTrajectory(random, pose, now - 1.0);
      const ObstacleScan scan = spoiledScan(random, now);
      ControlRequest request;
      request.now = spoiled(random, now, 0.02);
      request.odometry = i % 31 == 0 ? nullptr : &odometry;
      request.trajectory = i % 37 == 0 ? nullptr : &trajectory;
      request.trajectory_stamp = spoiled(random, now, 0.02);
      request.scan = i % 41 == 0 ? nullptr : &scan;
      request.T_odom_scan = spoiled(random, pose, 0.02);
      const ControlResult result = controller.step(request);
      ASSERT_LE(std::abs(result.twist.speed), limits().speed + 1e-9) << "seed " << seed << " step " << i;
      ASSERT_LE(std::abs(result.twist.turn_rate), limits().turn_rate + 1e-9) << "seed " << seed << " step " << i;
    }
  }
}

TEST(Hostile, aTrajectoryThatIsNotANumberStopsTheRobot) {
  ClosedLoop loop;
  const auto good = trajectoryOf({}, loop.now, 10.0, [](double) { return Twist2{1.0, 0.2}; });
  for (int i = 0; i < 100; ++i) loop.step(good);
  std::vector<TrajectoryPoint> points = good.points();
  for (TrajectoryPoint& p : points) p.twist.turn_rate = std::nan("");
  const SampledTrajectory bad(std::move(points));
  ControlResult result;
  for (int i = 0; i < 40; ++i) result = loop.step(bad);
  EXPECT_EQ(result.state, DriveState::kStopped);
  EXPECT_EQ(result.reason, "trajectory is not finite");
  EXPECT_EQ(result.twist.speed, 0.0);
  EXPECT_EQ(result.twist.turn_rate, 0.0);
}

TEST(Hostile, timeGoingBackStartsAfresh) {
  ClosedLoop loop;
  const auto trajectory = trajectoryOf({}, loop.now, 10.0, [](double) { return Twist2{1.0, 0.0}; });
  for (int i = 0; i < 100; ++i) loop.step(trajectory);
  loop.now = 10.0;
  loop.look();
  loop.drive = {{}, {0.5, 0.0}};
  const ControlResult result = loop.step(SampledTrajectory::standing({}, loop.now));
  EXPECT_NEAR(result.twist.speed, 0.5 - 0.04, 1e-9) << "goes on from what is measured, not from the old command";
}

TEST(Hostile, twoStepsAtTheSameTimeGiveTheSameCommand) {
  ClosedLoop loop;
  const auto trajectory = trajectoryOf({}, loop.now, 10.0, [](double) { return Twist2{1.0, 0.0}; });
  for (int i = 0; i < 10; ++i) loop.step(trajectory);
  const ControlResult first = loop.step(trajectory);
  loop.now -= ClosedLoop::kPeriod;
  EXPECT_EQ(loop.step(trajectory).twist.speed, first.twist.speed);
}

}  // namespace
}  // namespace parley

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

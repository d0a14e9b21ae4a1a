// SPDX-License-Identifier: BSD-3-Clause
#include "parley_geometry/trajectory.h"

#include <gtest/gtest.h>

#include <random>

namespace parley {
namespace {

using Eigen::Vector2d;

double uniform(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

SampledTrajectory circle() {
  std::vector<TrajectoryPoint> points;
  for (int i = 0; i <= 100; ++i) {
    points.push_back({10.0 + 0.1 * i, integrateTwist({}, 1.0, 0.7, 0.1 * i), {1.0, 0.7}});
  }
  return SampledTrajectory(std::move(points));
}

TEST(SampledTrajectory, interpolatesAndStandsOutside) {
  const SampledTrajectory trajectory = circle();
  std::mt19937 random(6);
  for (int i = 0; i < 1000; ++i) {
    const double time = uniform(random, 10.0, 20.0);
    const TrajectoryPoint p = trajectory.at(time);
    const Pose2 truth = integrateTwist({}, 1.0, 0.7, time - 10.0);
    ASSERT_LT((p.pose.position() - truth.position()).norm(), 1e-3);
    ASSERT_NEAR(angleBetween(p.pose.yaw, truth.yaw), 0.0, 1e-9);
    ASSERT_EQ(p.time, time);
    ASSERT_NEAR(p.twist.speed, 1.0, 1e-12);
  }
  EXPECT_EQ(trajectory.at(9.0).twist.speed, 0.0);
  EXPECT_TRUE(trajectory.at(9.0).pose == trajectory.points().front().pose);
  EXPECT_EQ(trajectory.at(99.0).twist.turn_rate, 0.0);
  EXPECT_TRUE(trajectory.at(99.0).pose == trajectory.points().back().pose);
  EXPECT_EQ(trajectory.at(10.0).twist.speed, 1.0);
  EXPECT_NEAR(trajectory.length(), 10.0, 0.01);
  EXPECT_EQ(trajectory.duration(), trajectory.endTime() - trajectory.startTime());
}

TEST(SampledTrajectory, twoStatesAtOneTime) {
  const SampledTrajectory trajectory({{0.0, {}, {}}, {1.0, {1.0, 0.0, 0.0}, {}}, {1.0, {1.0, 0.0, 0.5}, {}}});
  EXPECT_TRUE(trajectory.at(1.0).pose.isFinite());
  EXPECT_NEAR(trajectory.at(0.5).pose.x, 0.5, 1e-12);
}

TEST(SampledTrajectory, theRestOfIt) {
  const SampledTrajectory trajectory = circle();
  const SampledTrajectory rest = trajectory.from(13.33);
  EXPECT_EQ(rest.startTime(), 13.33);
  EXPECT_EQ(rest.endTime(), trajectory.endTime());
  for (double t = 13.33; t < 21.0; t += 0.07) {
    EXPECT_LT((rest.at(t).pose.position() - trajectory.at(t).pose.position()).norm(), 2e-3) << t;
  }
  EXPECT_EQ(trajectory.from(30.0).points().size(), 1u);
  EXPECT_EQ(trajectory.from(30.0).at(31.0).twist.speed, 0.0);
  EXPECT_NEAR(trajectory.from(5.0).length(), trajectory.length(), 1e-12);
}

TEST(SampledTrajectory, emptyAndStanding) {
  const SampledTrajectory empty;
  EXPECT_TRUE(empty.empty());
  EXPECT_EQ(empty.duration(), 0.0);
  EXPECT_EQ(empty.length(), 0.0);
  EXPECT_TRUE(empty.from(3.0).empty());
  const SampledTrajectory standing = SampledTrajectory::standing({1.0, 2.0, 3.0}, 7.0);
  EXPECT_FALSE(standing.empty());
  EXPECT_EQ(standing.duration(), 0.0);
  for (const double t : {0.0, 7.0, 99.0}) EXPECT_TRUE(standing.at(t).pose == (Pose2{1.0, 2.0, 3.0}));
}

TEST(BrakingTrajectory, staysWithinTheLimitsAndStops) {
  std::mt19937 random(8);
  const MotionLimits limits{2.0, kPi / 2.0, 2.0, 3.0};
  for (int i = 0; i < 300; ++i) {
    const double dt = uniform(random, 0.01, 0.1);
    const TrajectoryPoint from{5.0, {1.0, 1.0, 3.0}, {uniform(random, -2.0, 2.0), uniform(random, -1.5, 1.5)}};
    const SampledTrajectory braking = brakingTrajectory(from, limits, dt);
    const auto& points = braking.points();
    for (std::size_t k = 1; k < points.size(); ++k) {
      const Twist2 a = points[k - 1].twist, b = points[k].twist;
      ASSERT_NEAR(points[k].time - points[k - 1].time, dt, 1e-9);
      ASSERT_LE(std::abs(b.speed - a.speed), limits.acceleration * dt + 1e-9);
      ASSERT_LE(std::abs(b.turn_rate - a.turn_rate), limits.turn_acceleration * dt + 1e-9);
      ASSERT_LE(std::abs(b.speed), std::abs(a.speed));
      ASSERT_GE(b.speed * from.twist.speed, 0.0);
    }
    ASSERT_EQ(points.back().twist.speed, 0.0);
    ASSERT_EQ(points.back().twist.turn_rate, 0.0);
    const double needed = std::max(std::abs(from.twist.speed) / 2.0, std::abs(from.twist.turn_rate) / 3.0);
    ASSERT_LE(braking.duration(), needed + 2.0 * dt) << "case " << i;
  }
}

TEST(BrakingTrajectory, straightIsAsLongAsPhysicsSays) {
  const MotionLimits limits{2.0, 1.5, 2.0, 3.0};
  EXPECT_NEAR(brakingTrajectory({0.0, {}, {2.0, 0.0}}, limits, 0.01).length(), 1.0, 1e-6);
  EXPECT_NEAR(brakingTrajectory({0.0, {}, {-1.0, 0.0}}, limits, 0.01).points().back().pose.x, -0.25, 1e-6);
}

TEST(BrakingTrajectory, keepsItsCurvature) {
  const MotionLimits limits{2.0, 1.5, 2.0, 3.0};
  const SampledTrajectory braking = brakingTrajectory({0.0, {}, {1.0, 0.5}}, limits, 0.01);
  for (const TrajectoryPoint& p : braking.points()) {
    EXPECT_NEAR((p.pose.position() - Vector2d(0.0, 2.0)).norm(), 2.0, 1e-4);  // the circle it was on
  }
}

TEST(BrakingTrajectory, ofAStandingRobotIsItself) {
  const MotionLimits limits{2.0, 1.5, 2.0, 3.0};
  EXPECT_EQ(brakingTrajectory({0.0, {}, {}}, limits, 0.01).points().size(), 1u);
  const SampledTrajectory turning = brakingTrajectory({0.0, {}, {0.0, 1.5}}, limits, 0.01);
  EXPECT_NEAR(turning.points().back().pose.yaw, 1.5 * 1.5 / 6.0, 1e-6);
  EXPECT_NEAR(turning.length(), 0.0, 1e-12);
}

}  // namespace
}  // namespace parley

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

// SPDX-License-Identifier: BSD-3-Clause
#include "parley_sim/odometry_model.h"

#include <gtest/gtest.h>

#include <cmath>

namespace parley::sim {
namespace {

struct Spread {
  double x = 0.0, y = 0.0, yaw = 0.0;
};

/// Root mean square error after a motion of constant twist, over many robots.
Spread driftAfter(const Twist2& twist, double seconds, const OdometrySpec& spec) {
  Spread spread;
  const int robots = 600;
  for (int i = 0; i < robots; ++i) {
    OdometryModel model(spec, 0.0, RandomStream(1, "robot_" + std::to_string(i), "odometry"));
    Pose2 pose{5.0, -3.0, 1.0};
    const Pose2 start = pose;
    for (int k = 0; k < static_cast<int>(seconds / 0.01 + 0.5); ++k) {
      const Pose2 next = integrateTwist(pose, twist.speed, twist.turn_rate, 0.01);
      model.advance(pose, next, twist, 0.01);
      pose = next;
    }
    const Pose2 truth = start.inverse() * pose;
    spread.x += std::pow(model.pose().x - truth.x, 2) / robots;
    spread.y += std::pow(model.pose().y - truth.y, 2) / robots;
    spread.yaw += std::pow(angleBetween(truth.yaw, model.pose().yaw), 2) / robots;
  }
  return {std::sqrt(spread.x), std::sqrt(spread.y), std::sqrt(spread.yaw)};
}

TEST(OdometryModelTest, withoutNoiseItIsTheMotionInTheFrameOfTheStart) {
  const Spread none = driftAfter({1.0, 0.3}, 5.0, {50.0, 0.0, 0.0});
  EXPECT_NEAR(none.x + none.y + none.yaw, 0.0, 1e-9);
}

TEST(OdometryModelTest, driftGrowsWithTheSquareRootOfTheDistance) {
  const OdometrySpec spec{50.0, 0.01, 0.001};
  const Spread four = driftAfter({1.0, 0.0}, 4.0, spec), sixteen = driftAfter({1.0, 0.0}, 16.0, spec);
  EXPECT_NEAR(four.x, 0.02, 0.002);
  EXPECT_NEAR(sixteen.x, 0.04, 0.004);
  EXPECT_NEAR(four.yaw, 0.002, 0.0002);
  EXPECT_NEAR(sixteen.yaw, 0.004, 0.0004);
}

TEST(OdometryModelTest, turningOnTheSpotDriftsALittleAndStandingNotAtAll) {
  const OdometrySpec spec{50.0, 0.01, 0.001};
  const Spread turning = driftAfter({0.0, 1.0}, 10.0, spec);
  EXPECT_NEAR(turning.x, 0.0, 1e-9);
  EXPECT_GT(turning.yaw, 0.0005);
  EXPECT_LT(turning.yaw, 0.003);
  const Spread standing = driftAfter({0.0, 0.0}, 10.0, spec);
  EXPECT_NEAR(standing.x + standing.y + standing.yaw, 0.0, 1e-9);
}

TEST(OdometryModelTest, readingsCarryTwistAndAttitude) {
  OdometryModel model({}, 0.001, RandomStream(1, "r", "odometry"));
  const Odometry reading = model.reading(3.5, {1.5, -0.5}, {0.01, -0.02});
  EXPECT_EQ(reading.stamp, 3.5);
  EXPECT_NEAR(reading.twist.speed, 1.5, 0.02);
  EXPECT_NEAR(reading.twist.turn_rate, -0.5, 0.01);
  EXPECT_NEAR(reading.roll, 0.01, 0.006);
  EXPECT_NEAR(reading.pitch, -0.02, 0.006);
  OdometryModel planar({}, 0.0, RandomStream(1, "r", "odometry"));
  EXPECT_EQ(planar.reading(0.0, {}, {}).roll, 0.0);
}

TEST(AttitudeTest, isSmoothSmallAndEachRobotsOwn) {
  const Attitude a(0.012, RandomStream(1, "a", "attitude")), b(0.012, RandomStream(1, "b", "attitude")), level;
  double largest = 0.0;
  for (double t = 0.0; t < 60.0; t += 0.01) {
    largest = std::max({largest, std::abs(a.at(t).roll), std::abs(a.at(t).pitch)});
    EXPECT_LT(std::abs(a.at(t + 0.01).roll - a.at(t).roll), 0.001);
    EXPECT_EQ(level.at(t).pitch, 0.0);
  }
  EXPECT_LE(largest, 0.012);
  EXPECT_GT(largest, 0.006);
  EXPECT_NE(a.at(1.0).roll, b.at(1.0).roll);
}

}  // namespace
}  // namespace parley::sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

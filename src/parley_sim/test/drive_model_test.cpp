// SPDX-License-Identifier: BSD-3-Clause
#include "parley_sim/drive_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "parley_sim/random_stream.h"

namespace parley::sim {
namespace {

const MotionLimits kLimits{2.0, 1.5, 2.0, 4.0};
constexpr double kStep = 0.01;

TEST(DriveModelTest, neverExceedsItsLimits) {
  RandomStream random(1, "test", "drive");
  BodyState body;
  for (int i = 0; i < 5000; ++i) {
    const BodyState next = driven(body, {random.uniform(-9, 9), random.uniform(-9, 9)}, kLimits, kStep);
    EXPECT_LE(std::abs(next.twist.speed), kLimits.speed);
    EXPECT_LE(std::abs(next.twist.turn_rate), kLimits.turn_rate);
    EXPECT_LE(std::abs(next.twist.speed - body.twist.speed), kLimits.acceleration * kStep + 1e-12);
    EXPECT_LE(std::abs(next.twist.turn_rate - body.twist.turn_rate), kLimits.turn_acceleration * kStep + 1e-12);
    body = next;
  }
}

TEST(DriveModelTest, brakesInTheDistanceThatTheLimitsAllow) {
  BodyState body{{0, 0, 0}, {2.0, 0.0}};
  double time = 0.0;
  for (; body.twist.speed > 0.0; time += kStep) body = driven(body, {0, 0}, kLimits, kStep);
  EXPECT_NEAR(time, 1.0, 1e-9);
  EXPECT_NEAR(body.pose.x, 1.0, 1e-9);
  EXPECT_GT(brakingDistance({{}, {2.0, 0.0}}, kLimits), 1.0);
  EXPECT_LT(brakingDistance({{}, {0.0, 0.0}}, kLimits), 0.5);
}

TEST(DriveModelTest, constantTwistsGoRoundExactCircles) {
  BodyState body{{1, 2, 0}, {1.0, 0.5}};
  const int steps = 400;
  for (int i = 0; i < steps; ++i) body = driven(body, {1.0, 0.5}, kLimits, kStep);
  const double angle = 0.5 * steps * kStep;
  EXPECT_NEAR(body.pose.x, 1.0 + 2.0 * std::sin(angle), 1e-9);
  EXPECT_NEAR(body.pose.y, 2.0 + 2.0 * (1.0 - std::cos(angle)), 1e-9);
  EXPECT_NEAR(body.pose.yaw, angle, 1e-9);
}

TEST(DriveModelTest, commandsThatAreNotNumbersBrake) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  const BodyState moving{{0, 0, 0}, {1.0, 1.0}};
  for (const Twist2& command : {Twist2{nan, nan}, Twist2{infinity, -infinity}}) {
    const BodyState next = driven(moving, command, kLimits, kStep);
    EXPECT_NEAR(next.twist.speed, 1.0 - kLimits.acceleration * kStep, 1e-12);
    EXPECT_NEAR(next.twist.turn_rate, 1.0 - kLimits.turn_acceleration * kStep, 1e-12);
  }
}

}  // namespace
}  // namespace parley::sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

// SPDX-License-Identifier: BSD-3-Clause
#include "parley_geometry/pose2.h"

#include <gtest/gtest.h>

#include <random>

namespace parley {
namespace {

double uniform(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

Pose2 randomPose(std::mt19937& random) {
  return {uniform(random, -9.0, 9.0), uniform(random, -9.0, 9.0), uniform(random, -kPi, kPi)};
}

void expectSame(const Pose2& a, const Pose2& b, double tolerance = 1e-9) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(angleBetween(a.yaw, b.yaw), 0.0, tolerance);
}

TEST(Angles, wrapIntoTheHalfOpenInterval) {
  EXPECT_EQ(wrapAngle(kPi), -kPi);
  EXPECT_EQ(wrapAngle(-kPi), -kPi);
  EXPECT_EQ(wrapAngle(0.0), 0.0);
  EXPECT_EQ(wrapAngle(std::nextafter(-kPi, -4.0)) < kPi, true);
  std::mt19937 random(1);
  for (int i = 0; i < 10000; ++i) {
    const double angle = uniform(random, -100.0, 100.0), wrapped = wrapAngle(angle);
    ASSERT_GE(wrapped, -kPi) << angle;
    ASSERT_LT(wrapped, kPi) << angle;
    ASSERT_NEAR(std::sin(wrapped), std::sin(angle), 1e-12) << angle;
    ASSERT_NEAR(std::cos(wrapped), std::cos(angle), 1e-12) << angle;
  }
}

TEST(Angles, turnByTheShorterWay) {
  EXPECT_NEAR(angleBetween(3.0, -3.0), 2.0 * kPi - 6.0, 1e-12);
  EXPECT_NEAR(angleBetween(-3.0, 3.0), 6.0 - 2.0 * kPi, 1e-12);
  EXPECT_NEAR(degrees(radians(123.0)), 123.0, 1e-12);
  EXPECT_NEAR(radians(180.0), kPi, 1e-12);
}

TEST(Pose2, isAGroup) {
  std::mt19937 random(2);
  for (int i = 0; i < 1000; ++i) {
    const Pose2 a = randomPose(random), b = randomPose(random), c = randomPose(random);
    expectSame((a * b) * c, a * (b * c));
    expectSame(a * a.inverse(), {});
    expectSame(a.inverse() * a, {});
    expectSame(a * Pose2{}, a);
  }
}

TEST(Pose2, mapsPointsAsAHomogeneousMatrixDoes) {
  std::mt19937 random(3);
  for (int i = 0; i < 1000; ++i) {
    const Pose2 a = randomPose(random), b = randomPose(random);
    const Eigen::Vector2d p(uniform(random, -5.0, 5.0), uniform(random, -5.0, 5.0));
    Eigen::Matrix2d rotation;
    rotation << std::cos(a.yaw), -std::sin(a.yaw), std::sin(a.yaw), std::cos(a.yaw);
    ASSERT_LT((a * p - (rotation * p + a.position())).norm(), 1e-12);
    ASSERT_LT(((a * b) * p - a * (b * p)).norm(), 1e-9);
    ASSERT_LT((a * Eigen::Vector2d(1.0, 0.0) - a.position() - a.direction()).norm(), 1e-12);
  }
}

TEST(Pose2, interpolatesThroughTheWrap) {
  const Pose2 a{0.0, 0.0, 3.0}, b{2.0, -4.0, -3.0};
  expectSame(interpolate(a, b, 0.0), a);
  expectSame(interpolate(a, b, 1.0), b);
  const Pose2 middle = interpolate(a, b, 0.5);
  EXPECT_NEAR(std::abs(middle.yaw), kPi, 1e-9);
  EXPECT_NEAR(middle.x, 1.0, 1e-12);
}

TEST(Pose2, knowsWhetherItIsFinite) {
  EXPECT_TRUE((Pose2{1.0, 2.0, 3.0}).isFinite());
  EXPECT_FALSE((Pose2{NAN, 0.0, 0.0}).isFinite());
  EXPECT_FALSE((Pose2{0.0, INFINITY, 0.0}).isFinite());
  EXPECT_FALSE((Pose2{0.0, 0.0, NAN}).isFinite());
  EXPECT_TRUE((Pose2{1.0, 2.0, 3.0}) == (Pose2{1.0, 2.0, 3.0}));
  EXPECT_FALSE((Pose2{1.0, 2.0, 3.0}) == (Pose2{1.0, 2.0, 3.1}));
}

TEST(IntegrateTwist, equalsManySmallSteps) {
  std::mt19937 random(4);
  for (int i = 0; i < 50; ++i) {
    const Pose2 start = randomPose(random);
    const double speed = uniform(random, -2.0, 2.0), turn_rate = i == 0 ? 0.0 : uniform(random, -2.0, 2.0);
    const double dt = uniform(random, -2.0, 2.0);
    double x = start.x, y = start.y, yaw = start.yaw;
    constexpr int kSteps = 20000;
    for (int k = 0; k < kSteps; ++k) {
      const double heading = yaw + 0.5 * turn_rate * dt / kSteps;
      x += speed * dt / kSteps * std::cos(heading);
      y += speed * dt / kSteps * std::sin(heading);
      yaw += turn_rate * dt / kSteps;
    }
    expectSame(integrateTwist(start, speed, turn_rate, dt), {x, y, wrapAngle(yaw)}, 1e-6);
  }
}

TEST(IntegrateTwist, isSmoothWhereTheTurnVanishes) {
  for (const double turn_rate : {0.0, 1e-12, 0.9e-6, 1.1e-6}) {
    const Pose2 end = integrateTwist({}, 2.0, turn_rate, 1.0);
    EXPECT_NEAR(end.x, 2.0, 1e-9);
    EXPECT_NEAR(end.y, turn_rate, 1e-9);  // half of speed times turn rate times dt squared
  }
}

}  // namespace
}  // namespace parley

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

// SPDX-License-Identifier: BSD-3-Clause
#include "parley_robot/smooth_odometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace parley {
namespace {

constexpr MotionLimits kLimits{2.0, 1.5708, 2.0, 4.0};

/// Drives as its limits let it, and says so by an odometry with some noise.
struct Driver {
  explicit Driver(unsigned seed) : random(seed) {}
  Odometry step(double dt) {
    if (time >= next_turn) {
      next_turn = time + 0.7;
      wanted = {2.0 * uniform(), 1.5708 * uniform()};
    }
    const auto towards = [dt](double value, double target, double rate) {
      return value + std::clamp(target - value, -rate * dt, rate * dt);
    };
    const Twist2 before = twist;
    twist = {towards(twist.speed, wanted.speed, kLimits.acceleration),
             towards(twist.turn_rate, wanted.turn_rate, kLimits.turn_acceleration)};
    pose = integrateTwist(pose, 0.5 * (before.speed + twist.speed), 0.5 * (before.turn_rate + twist.turn_rate), dt);
    time += dt;
    const Pose2 noisy{pose.x + 0.01 * uniform(), pose.y + 0.01 * uniform(), wrapAngle(pose.yaw + 0.005 * uniform())};
    return {time, T_odom_world * noisy, says_twist ? twist : Twist2{}, 0.0, 0.0};
  }
  double uniform() { return std::uniform_real_distribution<double>(-1.0, 1.0)(random); }

  std::mt19937 random;
  double time = 0.0, next_turn = 0.0;
  Twist2 twist, wanted;
  Pose2 pose, T_odom_world;
  bool says_twist = true;
};

/// A correction that moves the pose by `step` as the robot sees it.
void correct(Driver& driver, const Pose2& step) {
  driver.T_odom_world = driver.T_odom_world * driver.pose * step * driver.pose.inverse();
}

double distance(const Pose2& a, const Pose2& b) { return (a.position() - b.position()).norm(); }

}  // namespace

TEST(SmoothOdometry, motionIsNoCorrection) {
  for (const double dt : {0.01, 0.02, 0.05, 0.1, 0.2}) {
    for (const bool says_twist : {true, false}) {
      if (!says_twist && dt > 0.05) continue;  // what has no twist must be quick
      Driver driver(3);
      driver.says_twist = says_twist;
      SmoothOdometry smooth({}, kLimits);
      for (int i = 0; i < 3000; ++i) {
        const Odometry reading = driver.step(dt);
        const Odometry local = smooth.add(reading);
        ASSERT_TRUE(local.pose == reading.pose) << dt << " s, " << i;
      }
      EXPECT_EQ(smooth.corrections(), 0);
    }
  }
}

TEST(SmoothOdometry, correctionsMoveTheFrameAndNotTheRobot) {
  const double degrees = kPi / 180.0;
  for (const double dt : {0.02, 0.05, 0.1}) {
    for (unsigned seed = 0; seed < 50; ++seed) {
      Driver driver(seed);
      SmoothOdometry smooth({}, kLimits);
      for (int i = 0; i < 40; ++i) smooth.add(driver.step(dt));
      const double bearing = kPi * driver.uniform();
      correct(driver, {0.3 * std::cos(bearing), 0.3 * std::sin(bearing), seed % 2 == 0 ? 3.0 * degrees : -3.0 * degrees});
      for (int i = 0; i < 40; ++i) {
        const Odometry reading = driver.step(dt);
        const Odometry local = smooth.add(reading);
        ASSERT_LT(distance(local.pose, driver.pose), 0.15) << "seed " << seed;
        ASSERT_LT(std::abs(angleBetween(local.pose.yaw, driver.pose.yaw)), 0.05) << "seed " << seed;
        ASSERT_LT(distance(smooth.odomFromLocal() * local.pose, reading.pose), 1e-9) << "seed " << seed;
      }
      ASSERT_EQ(smooth.corrections(), 1) << "seed " << seed << ", " << dt << " s";
    }
  }
}

TEST(SmoothOdometry, aVelocityThatHasTheCorrectionInItIsLimited) {
  SmoothOdometry smooth({}, kLimits);
  for (int i = 0; i < 5; ++i) smooth.add({0.1 * i, {0.1 * i, 0.0, 0.0}, {1.0, 0.0}, 0.0, 0.0});
  const Odometry local = smooth.add({0.5, {0.8, 0.0, 0.1}, {4.0, 1.0}, 0.0, 0.0});
  EXPECT_EQ(smooth.corrections(), 1);
  EXPECT_NEAR(local.pose.x, 0.5, 1e-9);
  EXPECT_NEAR(local.twist.speed, 1.2, 1e-9);
  EXPECT_NEAR(local.twist.turn_rate, 0.4, 1e-9);
}

TEST(SmoothOdometry, jumpsGapsAndRubbishPassThrough) {
  const double nan = std::nan("");
  SmoothOdometry smooth({}, kLimits);
  const auto passes = [&](const Odometry& reading) {
    return smooth.add(reading).pose == reading.pose && smooth.corrections() == 0;
  };
  EXPECT_TRUE(passes({0.0, {}, {}, 0.0, 0.0}));
  EXPECT_TRUE(passes({0.1, {1.5, 0.0, 0.0}, {}, 0.0, 0.0})) << "a jump";
  EXPECT_TRUE(passes({0.2, {1.5, 0.0, 0.0}, {}, 0.0, 0.0}));
  EXPECT_TRUE(passes({1.0, {2.0, 0.0, 0.0}, {}, 0.0, 0.0})) << "a gap";
  EXPECT_TRUE(passes({0.9, {2.4, 0.0, 0.0}, {}, 0.0, 0.0})) << "out of order";
  EXPECT_TRUE(passes({1.05, {2.0, 0.0, 0.0}, {}, 0.0, 0.0}));
  smooth.add({1.1, {nan, 0.0, 0.0}, {}, 0.0, 0.0});
  smooth.add({nan, {2.4, 0.0, 0.0}, {}, 0.0, 0.0});
  EXPECT_TRUE(passes({1.1, {2.0, 0.0, 0.0}, {}, 0.0, 0.0}));
  EXPECT_TRUE(passes({0.0, {2.4, 0.0, 0.0}, {}, 0.0, 0.0})) << "time went back";
  smooth.add({0.1, {2.7, 0.0, 0.0}, {}, 0.0, 0.0});
  EXPECT_EQ(smooth.corrections(), 1);
  EXPECT_NEAR(smooth.odomFromLocal().x, 0.3, 1e-9);
}

TEST(SmoothOdometry, aWrongReadingThatIsTakenBackLeavesNothing) {
  Driver driver(9);
  SmoothOdometry smooth({}, kLimits);
  for (int i = 0; i < 40; ++i) smooth.add(driver.step(0.05));
  correct(driver, {0.0, 0.5, 0.0});
  smooth.add(driver.step(0.05));
  driver.T_odom_world = {};
  for (int i = 0; i < 40; ++i) smooth.add(driver.step(0.05));
  EXPECT_EQ(smooth.corrections(), 2);
  EXPECT_LT(smooth.odomFromLocal().position().norm(), 0.1);
}

}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

// SPDX-License-Identifier: BSD-3-Clause
#include "parley_geometry/twist_estimator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "parley_geometry/option_conformance.h"

namespace parley {
namespace {

constexpr double kPeriod = 0.05;  // [s] a lidar at 20 Hz
const MotionLimits kLimits{2.0, 1.5708, 2.0, 4.0};

/// A robot that drives by a law of time, with its poses measured at the period.
class Drive {
 public:
  using Law = std::function<Twist2(double)>;

  explicit Drive(Law law, double noise = 0.0, unsigned seed = 1) : law_(std::move(law)), noise_(noise), random_(seed) {}

  /// The estimate after one more period.
  std::optional<Twist2> step() {
    constexpr int kSteps = 50;
    for (int i = 0; i < kSteps; ++i) {
      const Twist2 twist = law_(time_ + 0.5 * kPeriod / kSteps);
      pose_ = integrateTwist(pose_, twist.speed, twist.turn_rate, kPeriod / kSteps);
      time_ += kPeriod / kSteps;
    }
    return estimator_.add(time_, measured());
  }

  Twist2 truth() const { return law_(time_); }
  Pose2 measured() {
    std::normal_distribution<double> position(0.0, 0.003 * noise_), angle(0.0, 0.002 * noise_);
    return {pose_.x + position(random_), pose_.y + position(random_), pose_.yaw + angle(random_)};
  }

  Pose2 pose_{1.0, 2.0, 3.0};
  double time_ = 100.0;  // [s]
  TwistEstimator estimator_{TwistOptions{}, kLimits};

 private:
  Law law_;
  double noise_;
  std::mt19937 random_;
};

Drive::Law constant(double speed, double turn_rate) {
  return [=](double) { return Twist2{speed, turn_rate}; };
}

TEST(TwistEstimator, isExactOnAnArcInEitherDirection) {
  for (const Twist2 twist : {Twist2{1.5, 1.0}, Twist2{-0.8, 0.5}, Twist2{0.0, -1.5}, Twist2{2.0, 0.0}}) {
    Drive drive(constant(twist.speed, twist.turn_rate));
    EXPECT_FALSE(drive.step()) << "one pose says nothing of the velocity";
    for (int i = 0; i < 100; ++i) {
      const auto found = drive.step();
      ASSERT_TRUE(found);
      const double tolerance = i > 10 ? 1e-3 : 0.02;  // the heading passes the wrap on the way
      ASSERT_NEAR(found->speed, twist.speed, tolerance) << i;
      ASSERT_NEAR(found->turn_rate, twist.turn_rate, tolerance) << i;
    }
  }
}

TEST(TwistEstimator, isQuieterThanTheDifferenceOfTwoPoses) {
  Drive drive(constant(1.0, 0.5), 1.0);
  for (int i = 0; i < 20; ++i) drive.step();
  double estimated = 0.0, differenced = 0.0;
  Pose2 last = drive.measured();
  constexpr int kCount = 2000;
  for (int i = 0; i < kCount; ++i) {
    estimated += std::pow(drive.step()->speed - 1.0, 2) / kCount;
    const Pose2 now = drive.measured();
    differenced += std::pow((now.position() - last.position()).norm() / kPeriod - 1.0, 2) / kCount;
    last = now;
  }
  EXPECT_LT(std::sqrt(estimated), 0.06);
  EXPECT_LT(std::sqrt(estimated), 0.8 * std::sqrt(differenced));
}

TEST(TwistEstimator, isLessThanAPeriodBehindInFullBraking) {
  const double begin = 102.0;
  Drive drive([=](double t) { return Twist2{std::clamp(2.0 - kLimits.acceleration * (t - begin), 0.0, 2.0), 0.0}; });
  double worst = 0.0;
  drive.step();
  while (drive.time_ < 104.0) worst = std::max(worst, std::abs(drive.step()->speed - drive.truth().speed));
  EXPECT_LT(worst, kLimits.acceleration * kPeriod);
}

TEST(TwistEstimator, aStandingRobotHasNoVelocityHoweverItsPosesTremble) {
  Drive drive(constant(0.0, 0.0), 0.4);
  for (int i = 0; i < 15; ++i) drive.step();
  for (int i = 0; i < 500; ++i) {
    const auto found = drive.step();
    ASSERT_EQ(found->speed, 0.0) << i;
    ASSERT_EQ(found->turn_rate, 0.0) << i;
  }
}

TEST(TwistEstimator, seesADepartureWithinThreePoses) {
  const double begin = 102.0;
  for (const Twist2 acceleration : {Twist2{1.0, 0.0}, Twist2{0.0, 2.0}}) {
    Drive drive([=](double t) {
      const double since = std::max(0.0, t - begin);
      return Twist2{acceleration.speed * since, acceleration.turn_rate * since};
    });
    while (drive.time_ < begin + 3.5 * kPeriod) drive.step();
    const auto found = drive.step();
    EXPECT_NEAR(found->speed, drive.truth().speed, 0.06);
    EXPECT_NEAR(found->turn_rate, drive.truth().turn_rate, 0.12);
  }
}

TEST(TwistEstimator, aCorrectionOfThePosesIsNoMotion) {
  Drive drive(constant(1.0, 0.3));
  for (int i = 0; i < 40; ++i) drive.step();
  drive.pose_.x += 0.4;
  drive.pose_.yaw += 0.5;
  for (int i = 0; i < 20; ++i) {
    const auto found = drive.step();
    ASSERT_TRUE(found);
    ASSERT_NEAR(found->speed, 1.0, 0.01) << i;
    ASSERT_NEAR(found->turn_rate, 0.3, 0.01) << i;
  }
  EXPECT_EQ(drive.estimator_.corrections(), 1);
}

TEST(TwistEstimator, saysNothingWhereTheDriveCannotBeAsFastAsThePoses) {
  Drive drive(constant(5.0, 0.0));
  for (int i = 0; i < 10; ++i) EXPECT_FALSE(drive.step());
  EXPECT_EQ(drive.estimator_.corrections(), 9);
}

TEST(TwistEstimator, startsAgainAfterAGap) {
  Drive drive(constant(1.0, 0.0));
  for (int i = 0; i < 20; ++i) drive.step();
  drive.time_ += 1.0;
  EXPECT_FALSE(drive.step());
  EXPECT_NEAR(drive.step()->speed, 1.0, 0.02);
  drive.estimator_.reset();
  EXPECT_FALSE(drive.step());
}

TEST(TwistEstimator, itsOptionsAreDocumentedAndInTheFile) {
  expectDefaultsInRange<TwistOptions>();
  expectFileHoldsDefaults<TwistOptions>(PARLEY_CONFIG_DIR "/odometry.yaml");
  expectTableIn<TwistOptions>(PARLEY_GEOMETRY_DIR "/README.md");
}

}  // namespace
}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

// SPDX-License-Identifier: BSD-3-Clause
#include "parley_geometry/trajectory.h"

#include <gtest/gtest.h>

#include <random>

#include "parley_geometry/polynomial.h"

namespace parley {
namespace {

using Eigen::Vector2d;

double uniform(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

FlatState randomState(std::mt19937& random) {
  const auto vector = [&](double reach) { return Vector2d(uniform(random, -reach, reach), uniform(random, -reach, reach)); };
  return {vector(4.0), vector(2.0), vector(2.0)};
}

TEST(QuinticPiece, joinsItsEnds) {
  std::mt19937 random(1);
  for (int i = 0; i < 300; ++i) {
    const FlatState a = randomState(random), b = randomState(random);
    const double duration = uniform(random, 0.2, 5.0);
    const QuinticPiece piece = QuinticPiece::between(a, b, duration);
    const FlatState start = piece.at(0.0), end = piece.at(duration);
    ASSERT_EQ(piece.duration(), duration);
    ASSERT_LT((start.position - a.position).norm() + (end.position - b.position).norm(), 1e-9);
    ASSERT_LT((start.velocity - a.velocity).norm() + (end.velocity - b.velocity).norm(), 1e-8);
    ASSERT_LT((start.acceleration - a.acceleration).norm() + (end.acceleration - b.acceleration).norm(), 1e-7);
  }
}

TEST(QuinticPiece, derivativesAgreeWithDifferences) {
  std::mt19937 random(2);
  for (int i = 0; i < 300; ++i) {
    const double duration = uniform(random, 0.5, 4.0), h = 1e-5;
    const QuinticPiece piece = QuinticPiece::between(randomState(random), randomState(random), duration);
    const double t = uniform(random, h, duration - h);
    const FlatState before = piece.at(t - h), now = piece.at(t), after = piece.at(t + h);
    const double scale = 1e-5 * (1.0 + piece.jerk(t).norm() + now.acceleration.norm() + now.velocity.norm());
    ASSERT_LT(((after.position - before.position) / (2.0 * h) - now.velocity).norm(), scale) << "case " << i;
    ASSERT_LT(((after.velocity - before.velocity) / (2.0 * h) - now.acceleration).norm(), scale) << "case " << i;
    ASSERT_LT(((after.acceleration - before.acceleration) / (2.0 * h) - piece.jerk(t)).norm(), scale) << "case " << i;
  }
}

TEST(QuinticPiece, jerkCostAgreesWithSummation) {
  std::mt19937 random(3);
  for (int i = 0; i < 100; ++i) {
    const double duration = uniform(random, 0.3, 4.0);
    const QuinticPiece piece = QuinticPiece::between(randomState(random), randomState(random), duration);
    constexpr int kSteps = 4000;
    double sum = 0.0;
    for (int k = 0; k < kSteps; ++k) sum += piece.jerk((k + 0.5) * duration / kSteps).squaredNorm() * duration / kSteps;
    ASSERT_NEAR(piece.jerkCost() / sum, 1.0, 1e-5) << "case " << i;
  }
}

TEST(QuinticPiece, constantAccelerationCostsNothing) {
  const FlatState a{{1.0, 2.0}, {0.5, -0.5}, {0.2, 0.4}};
  const double t = 2.0;
  const FlatState b{a.position + t * a.velocity + 0.5 * t * t * a.acceleration, a.velocity + t * a.acceleration, a.acceleration};
  EXPECT_NEAR(QuinticPiece::between(a, b, t).jerkCost(), 0.0, 1e-20);
  EXPECT_EQ(QuinticPiece().jerkCost(), 0.0);
}

PolynomialTrajectory randomPolynomial(std::mt19937& random, int pieces) {
  PolynomialTrajectory trajectory;
  trajectory.start_time = 50.0;
  FlatState from = randomState(random);
  for (int i = 0; i < pieces; ++i) {
    const FlatState to = randomState(random);
    trajectory.pieces.push_back(QuinticPiece::between(from, to, uniform(random, 0.5, 2.0)));
    from = to;
  }
  return trajectory;
}

TEST(PolynomialTrajectory, isContinuousAndClampedToItsEnds) {
  std::mt19937 random(4);
  for (int i = 0; i < 50; ++i) {
    const PolynomialTrajectory trajectory = randomPolynomial(random, 4);
    const double end = trajectory.start_time + trajectory.duration();
    double joint = trajectory.start_time;
    for (const QuinticPiece& piece : trajectory.pieces) {
      joint += piece.duration();
      const FlatState before = trajectory.at(joint - 1e-9), after = trajectory.at(joint + 1e-9);
      ASSERT_LT((after.position - before.position).norm(), 1e-6);
      ASSERT_LT((after.velocity - before.velocity).norm(), 1e-6);
    }
    ASSERT_LT((trajectory.at(0.0).position - trajectory.at(trajectory.start_time).position).norm(), 1e-12);
    ASSERT_LT((trajectory.at(end + 9.0).position - trajectory.at(end).position).norm(), 1e-9);
  }
}

TEST(PolynomialTrajectory, samplesMoveAsADifferentialDriveDoes) {
  std::mt19937 random(5);
  for (const bool reverse : {false, true}) {
    PolynomialTrajectory trajectory = randomPolynomial(random, 3);
    trajectory.reverse = reverse;
    const SampledTrajectory sampled = trajectory.sampled(0.001, 0.0);
    EXPECT_NEAR(sampled.duration(), trajectory.duration(), 1e-9);
    EXPECT_EQ(sampled.startTime(), 50.0);
    for (std::size_t i = 1; i < sampled.points().size(); ++i) {
      const TrajectoryPoint &a = sampled.points()[i - 1], &b = sampled.points()[i];
      if (std::abs(a.twist.speed) < 0.3) continue;  // near a cusp a millisecond is long
      const Pose2 moved = integrateTwist(a.pose, a.twist.speed, a.twist.turn_rate, b.time - a.time);
      ASSERT_LT((moved.position() - b.pose.position()).norm(), 5e-5) << "at " << a.time;
      ASSERT_LT(std::abs(angleBetween(moved.yaw, b.pose.yaw)), 5e-3) << "at " << a.time;
      ASSERT_EQ(a.twist.speed < 0.0, reverse);
    }
  }
}

TEST(PolynomialTrajectory, holdsItsHeadingWhereItStands) {
  PolynomialTrajectory trajectory;
  trajectory.pieces = {QuinticPiece::between({}, {{0.0, 2.0}, {0.0, 0.0}, {0.0, 0.0}}, 3.0)};
  const SampledTrajectory sampled = trajectory.sampled(0.7, 0.3);
  EXPECT_EQ(sampled.points().size(), 6u);
  EXPECT_EQ(sampled.points().front().pose.yaw, 0.3);
  EXPECT_NEAR(sampled.points()[1].pose.yaw, 0.5 * kPi, 1e-9);
  EXPECT_NEAR(sampled.points().back().pose.yaw, 0.5 * kPi, 1e-9);
  EXPECT_EQ(sampled.endTime(), 3.0);
  EXPECT_NEAR(sampled.points().back().twist.speed, 0.0, 1e-12);
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

// SPDX-License-Identifier: BSD-3-Clause
// Single quintics and curves of them: polynomial, piecewise_quintic.
#include "parley_geometry/piecewise_quintic.h"

#include <gtest/gtest.h>

#include <random>

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

constexpr double kStart = 50.0;  // [s]

std::vector<FlatState> randomKnots(std::mt19937& random, int pieces) {
  std::vector<FlatState> knots;
  for (int i = 0; i <= pieces; ++i) knots.push_back(randomState(random));
  return knots;
}

TEST(PiecewiseQuintic, goesThroughItsKnotsContinuously) {
  std::mt19937 random(4);
  for (int i = 0; i < 50; ++i) {
    const std::vector<FlatState> knots = randomKnots(random, 4);
    const PiecewiseQuintic curve(knots, uniform(random, 2.0, 6.0));
    ASSERT_EQ(curve.pieceCount(), 4u);
    for (std::size_t k = 0; k < knots.size(); ++k) {
      const double joint = curve.duration() * static_cast<double>(k) / 4.0;
      for (const double beside : {-1e-9, 0.0, 1e-9}) {
        const FlatState state = curve.at(joint + beside);
        ASSERT_LT((state.position - knots[k].position).norm(), 1e-6);
        ASSERT_LT((state.velocity - knots[k].velocity).norm(), 1e-6);
        ASSERT_LT((state.acceleration - knots[k].acceleration).norm(), 1e-5);
      }
    }
    ASSERT_LT((curve.at(-1.0).position - knots.front().position).norm(), 1e-12);
    ASSERT_LT((curve.at(99.0).position - knots.back().position).norm(), 1e-9);
  }
}

TEST(PiecewiseQuintic, jerkIsThatOfTheCurve) {
  std::mt19937 random(7);
  for (int i = 0; i < 50; ++i) {
    const PiecewiseQuintic curve(randomKnots(random, 3), uniform(random, 2.0, 6.0));
    const double h = 1e-5;
    constexpr int kSteps = 3000;  // a multiple of the pieces: no step lies on a knot
    double sum = 0.0;
    for (int k = 0; k < kSteps; ++k) {
      const double t = (k + 0.5) * curve.duration() / kSteps;
      sum += curve.jerk(t).squaredNorm() * curve.duration() / kSteps;
      if (k % 100 != 0) continue;
      const Vector2d differences = (curve.at(t + h).acceleration - curve.at(t - h).acceleration) / (2.0 * h);
      ASSERT_LT((differences - curve.jerk(t)).norm(), 1e-5 * (1.0 + curve.jerk(t).norm()));
    }
    ASSERT_NEAR(curve.jerkCost() / sum, 1.0, 1e-5) << "case " << i;
  }
}

TEST(PiecewiseQuintic, samplesMoveAsADifferentialDriveDoes) {
  std::mt19937 random(5);
  for (const bool reverse : {false, true}) {
    const PiecewiseQuintic curve(randomKnots(random, 3), uniform(random, 2.0, 6.0));
    const SampledTrajectory sampled = curve.sampled(kStart, 0.001, 0.0, reverse);
    EXPECT_NEAR(sampled.duration(), curve.duration(), 1e-9);
    EXPECT_EQ(sampled.startTime(), kStart);
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

TEST(PiecewiseQuintic, holdsItsHeadingWhereItStands) {
  const PiecewiseQuintic curve({{}, {{0.0, 2.0}, {0.0, 0.0}, {0.0, 0.0}}}, 3.0);
  const SampledTrajectory sampled = curve.sampled(0.0, 0.7, 0.3);
  EXPECT_EQ(sampled.points().size(), 6u);
  EXPECT_EQ(sampled.points().front().pose.yaw, 0.3);
  EXPECT_NEAR(sampled.points()[1].pose.yaw, 0.5 * kPi, 1e-9);
  EXPECT_NEAR(sampled.points().back().pose.yaw, 0.5 * kPi, 1e-9);
  EXPECT_EQ(sampled.endTime(), 3.0);
  EXPECT_NEAR(sampled.points().back().twist.speed, 0.0, 1e-12);
}

}  // namespace
}  // namespace parley

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

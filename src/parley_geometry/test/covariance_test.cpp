// SPDX-License-Identifier: BSD-3-Clause
#include "parley_geometry/covariance.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <functional>
#include <random>
#include <vector>

namespace parley {
namespace {

double uniform(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

/// Errors of some centimetres and some hundredths of a radian, correlated.
Covariance3 randomCovariance(std::mt19937& random) {
  Eigen::Matrix3d root;
  for (int i = 0; i < 9; ++i) root(i) = uniform(random, -0.02, 0.02);
  return root * root.transpose() + 1e-5 * Eigen::Matrix3d::Identity();
}

PoseEstimate randomEstimate(std::mt19937& random) {
  return {{uniform(random, -3.0, 3.0), uniform(random, -3.0, 3.0), uniform(random, -kPi, kPi)}, randomCovariance(random)};
}

/// A pose as it may truly be: the error is in the axes of the parent frame.
Pose2 sample(std::mt19937& random, const PoseEstimate& estimate) {
  std::normal_distribution<double> normal;
  const Eigen::Vector3d unit(normal(random), normal(random), normal(random));
  const Eigen::Vector3d error = Eigen::Matrix3d(estimate.covariance.llt().matrixL()) * unit;
  return {estimate.pose.x + error.x(), estimate.pose.y + error.y(), estimate.pose.yaw + error.z()};
}

Eigen::Vector3d difference(const Pose2& a, const Pose2& b) { return {a.x - b.x, a.y - b.y, angleBetween(b.yaw, a.yaw)}; }

Covariance3 monteCarlo(const Pose2& mean, const std::function<Pose2()>& draw) {
  constexpr int kSamples = 40000;
  Covariance3 sum = Covariance3::Zero();
  for (int i = 0; i < kSamples; ++i) {
    const Eigen::Vector3d error = difference(draw(), mean);
    sum += error * error.transpose();
  }
  return sum / kSamples;
}

/// Largest relative error of a variance in any direction.
double mismatch(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  const Eigen::MatrixXd inverse_root = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(b).operatorInverseSqrt();
  const Eigen::MatrixXd relative = inverse_root * a * inverse_root - Eigen::MatrixXd::Identity(a.rows(), a.cols());
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(relative).eigenvalues().cwiseAbs().maxCoeff();
}

TEST(Covariance, composeAgreesWithMonteCarlo) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    std::mt19937 random(seed);
    const PoseEstimate a = randomEstimate(random), b = randomEstimate(random);
    const PoseEstimate c = compose(a, b);
    EXPECT_LT(difference(c.pose, a.pose * b.pose).norm(), 1e-12);
    const Covariance3 truth = monteCarlo(c.pose, [&] { return sample(random, a) * sample(random, b); });
    EXPECT_LT(mismatch(c.covariance, truth), 0.06) << "seed " << seed;
  }
}

TEST(Covariance, inverseAgreesWithMonteCarlo) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    std::mt19937 random(seed);
    const PoseEstimate a = randomEstimate(random);
    const PoseEstimate b = inverse(a);
    EXPECT_LT(difference(b.pose, a.pose.inverse()).norm(), 1e-12);
    const Covariance3 truth = monteCarlo(b.pose, [&] { return sample(random, a).inverse(); });
    EXPECT_LT(mismatch(b.covariance, truth), 0.06) << "seed " << seed;
  }
}

TEST(Covariance, pointAgreesWithMonteCarlo) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    std::mt19937 random(seed);
    const PoseEstimate a = randomEstimate(random);
    const Eigen::Vector2d p(uniform(random, -4.0, 4.0), uniform(random, -4.0, 4.0));
    Eigen::Matrix2d truth = Eigen::Matrix2d::Zero();
    constexpr int kSamples = 40000;
    for (int i = 0; i < kSamples; ++i) {
      const Eigen::Vector2d error = sample(random, a) * p - a.pose * p;
      truth += error * error.transpose() / kSamples;
    }
    EXPECT_LT(mismatch(pointCovariance(a, p), truth), 0.06) << "seed " << seed;
  }
}

TEST(Covariance, rulesFitTogether) {
  std::mt19937 random(7);
  for (int i = 0; i < 300; ++i) {
    const PoseEstimate a = randomEstimate(random), b = randomEstimate(random), c = randomEstimate(random);
    EXPECT_TRUE(inverse(inverse(a)).covariance.isApprox(a.covariance, 1e-9));
    EXPECT_TRUE(compose(compose(a, b), c).covariance.isApprox(compose(a, compose(b, c)).covariance, 1e-9));
    const Covariance3 one_way = inverse(compose(a, b)).covariance;
    EXPECT_TRUE(one_way.isApprox(compose(inverse(b), inverse(a)).covariance, 1e-9));
    EXPECT_TRUE(isCovariance(compose(a, b).covariance));
  }
}

TEST(Covariance, compositionWithACertainPoseOnlyTurns) {
  const PoseEstimate certain{{1.0, 2.0, 0.5 * kPi}, Covariance3::Zero()};
  PoseEstimate b;
  b.covariance = Eigen::Vector3d(0.04, 0.01, 0.02).asDiagonal();
  const Covariance3 c = compose(certain, b).covariance;
  EXPECT_TRUE(c.isApprox(Covariance3(Eigen::Vector3d(0.01, 0.04, 0.02).asDiagonal()), 1e-12));
}

TEST(Covariance, refusesWhatIsNone) {
  const Covariance3 good = Eigen::Vector3d(0.1, 0.2, 0.3).asDiagonal();
  EXPECT_TRUE(isCovariance(good));
  EXPECT_FALSE(isCovariance(Covariance3::Zero()));
  EXPECT_FALSE(isCovariance(-good));
  Covariance3 bad = good;
  bad(0, 1) = 0.05;
  EXPECT_FALSE(isCovariance(bad)) << "not symmetric";
  bad = good;
  bad(0, 1) = bad(1, 0) = 0.5;
  EXPECT_FALSE(isCovariance(bad)) << "not positive definite";
  for (const double value : {NAN, INFINITY}) {
    bad = good;
    bad(2, 2) = value;
    EXPECT_FALSE(isCovariance(bad)) << value;
  }
}

}  // namespace
}  // namespace parley

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

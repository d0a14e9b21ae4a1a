// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph.h"

#include <ceres/ceres.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <optional>
#include <random>

#include "clique.h"
#include "relative_pose_error.h"

namespace parley {
namespace {

using Joined = std::vector<std::vector<bool>>;

std::size_t largestByTrying(const Joined& joined) {
  std::size_t best = 0;
  for (unsigned set = 1; set < (1U << joined.size()); ++set) {
    std::size_t size = 0;
    bool is_clique = true;
    for (std::size_t i = 0; i < joined.size(); ++i) {
      if ((set >> i & 1U) == 0) continue;
      ++size;
      for (std::size_t j = 0; j < i; ++j) is_clique = is_clique && ((set >> j & 1U) == 0 || joined[i][j]);
    }
    if (is_clique) best = std::max(best, size);
  }
  return best;
}

Covariance3 covariance(double metres, double radians) {
  return Eigen::Vector3d(metres * metres, metres * metres, radians * radians).asDiagonal();
}

Pose2 noisy(const Pose2& pose, const Covariance3& spread, std::mt19937& random) {
  std::normal_distribution<double> normal(0.0, 1.0);
  const Eigen::Vector3d e = spread.llt().matrixL() * Eigen::Vector3d(normal(random), normal(random), normal(random));
  return {pose.x + e.x(), pose.y + e.y(), wrapAngle(pose.yaw + e.z())};
}

/// Robots a, b and c whose odom frames are known in the world.
const Pose2 kOdomA{1.0, 2.0, 0.5}, kOdomB{-4.0, 1.0, 2.0}, kOdomC{3.0, -6.0, -2.5};

RelativeEdge edgeOf(const std::string& from, const Pose2& T_world_fromodom, const Pose2& here, const std::string& to,
                    const Pose2& T_world_toodom, const Pose2& there, double stamp, double travel) {
  const Pose2 T_from_to = (T_world_fromodom * here).inverse() * (T_world_toodom * there);
  return {from, to, stamp, here, there, travel, travel, {T_from_to, covariance(0.03, 0.01)}};
}

}  // namespace

TEST(Clique, isTheLargestByTryingAll) {
  std::mt19937 random(11);
  for (int trial = 0; trial < 200; ++trial) {
    const std::size_t count = 1 + random() % 11;
    Joined joined(count, std::vector<bool>(count, false));
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = 0; j < i; ++j) joined[i][j] = joined[j][i] = random() % 10 < 6;
    }
    const std::vector<int> clique = maximumClique(joined);
    EXPECT_EQ(clique.size(), largestByTrying(joined)) << trial;
    for (const int i : clique) {
      for (const int j : clique) EXPECT_TRUE(i == j || joined[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)]);
    }
  }
  EXPECT_TRUE(maximumClique({}).empty());
  EXPECT_EQ(maximumClique(Joined(64, std::vector<bool>(64, true))).size(), 64U);
}

TEST(RelativePoseError, derivativesAreRight) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int trial = 0; trial < 50; ++trial) {
    const Pose2 measured{unit(random), unit(random), 3.1 * unit(random)};
    Eigen::Matrix3d root = Eigen::Matrix3d::Random() + 3.0 * Eigen::Matrix3d::Identity();
    ceres::AutoDiffCostFunction<RelativePoseError, 3, 3, 3> cost(new RelativePoseError(measured, root));
    const RelativePoseError error(measured, root);
    std::array<double, 3> a{5 * unit(random), 5 * unit(random), 6 * unit(random)},
        b{5 * unit(random), 5 * unit(random), 6 * unit(random)};
    std::array<double, 3> residual{};
    std::array<double, 9> by_a{}, by_b{};
    std::array<const double*, 2> parameters{a.data(), b.data()};
    std::array<double*, 2> jacobians{by_a.data(), by_b.data()};
    ASSERT_TRUE(cost.Evaluate(parameters.data(), residual.data(), jacobians.data()));
    for (std::size_t column = 0; column < 6; ++column) {
      constexpr double kStep = 1e-6;
      std::array<double, 3> low{}, high{};
      double& value = column < 3 ? a[column] : b[column - 3];
      value += kStep;
      error(a.data(), b.data(), high.data());
      value -= 2.0 * kStep;
      error(a.data(), b.data(), low.data());
      value += kStep;
      for (std::size_t row = 0; row < 3; ++row) {
        const double analytic = column < 3 ? by_a[3 * row + column] : by_b[3 * row + column - 3];
        EXPECT_NEAR(analytic, (high[row] - low[row]) / (2.0 * kStep), 1e-5) << trial;
      }
    }
  }
}

TEST(PoseGraph, twoEdgesMakeAChain) {
  PoseGraph graph({}, "a");
  graph.add(edgeOf("a", kOdomA, {1.0, 1.0, 0.2}, "b", kOdomB, {0.5, -1.0, 1.0}, 10.0, 5.0));
  graph.add(edgeOf("c", kOdomC, {2.0, 0.0, 0.1}, "b", kOdomB, {1.5, -1.0, 1.2}, 12.0, 6.0));
  const auto estimates = graph.solve({{1.5, 1.2, 0.3}, 5.6});
  ASSERT_EQ(estimates.count("c"), 1U);
  const Pose2 truth = kOdomA.inverse() * kOdomC, found = estimates.at("c").T_odom_peerodom.pose;
  EXPECT_NEAR(found.x, truth.x, 1e-6);
  EXPECT_NEAR(found.y, truth.y, 1e-6);
  EXPECT_NEAR(angleBetween(found.yaw, truth.yaw), 0.0, 1e-7);
  EXPECT_TRUE(isCovariance(estimates.at("c").T_odom_peerodom.covariance));
  EXPECT_GT(estimates.at("c").T_odom_peerodom.covariance.trace(), estimates.at("b").T_odom_peerodom.covariance.trace());
  graph.forget("b");
  EXPECT_TRUE(graph.solve({{1.5, 1.2, 0.3}, 5.6}).empty());
}

/// Whatever else has been allocated and freed between the solutions.
TEST(PoseGraph, sameEdgesGiveTheSameBits) {
  std::mt19937 random(5);
  std::vector<std::vector<char>> ballast;
  std::optional<Covariance3> first;
  for (int trial = 0; trial < 200; ++trial) {
    for (int i = 0; i < 40; ++i) ballast.emplace_back(16 + random() % 400);
    for (int i = 0; i < 30; ++i) ballast.erase(ballast.begin() + static_cast<std::ptrdiff_t>(random() % ballast.size()));
    PoseGraph graph({}, "a");
    graph.add(edgeOf("a", kOdomA, {1.0, 1.0, 0.2}, "b", kOdomB, {0.5, -1.0, 1.0}, 10.0, 5.0));
    graph.add(edgeOf("b", kOdomB, {3.5, 0.0, 1.3}, "c", kOdomC, {2.0, 0.0, 0.1}, 12.0, 8.5));
    graph.add(edgeOf("a", kOdomA, {4.0, 1.5, 0.4}, "c", kOdomC, {1.0, -2.0, 0.7}, 14.0, 9.5));
    const Covariance3 found = graph.solve({{4.5, 1.2, 0.3}, 10.0}).at("c").T_odom_peerodom.covariance;
    if (!first) first = found;
    ASSERT_TRUE(found == *first) << "solution " << trial;
  }
}

TEST(PoseGraph, covarianceIsThatOfTrials) {
  RelativeLocalizationOptions options;
  const Pose2 here{1.0, 1.0, 0.2}, there_b{0.5, -1.0, 1.0}, later_b{3.5, 0.0, 1.3}, here_c{2.0, 0.0, 0.1};
  std::mt19937 random(3);
  const Pose2 truth = kOdomA.inverse() * kOdomC;
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero(), said = Eigen::Matrix3d::Zero();
  constexpr int kTrials = 400;
  for (int trial = 0; trial < kTrials; ++trial) {
    PoseGraph graph(options, "a");
    RelativeEdge ab = edgeOf("a", kOdomA, here, "b", kOdomB, there_b, 10.0, 5.0);
    RelativeEdge bc = edgeOf("b", kOdomB, later_b, "c", kOdomC, here_c, 12.0, 8.5);
    ab.T_from_to.pose = noisy(ab.T_from_to.pose, ab.T_from_to.covariance, random);
    bc.T_from_to.pose = noisy(bc.T_from_to.pose, bc.T_from_to.covariance, random);
    bc.T_odom_from = there_b * noisy(there_b.inverse() * later_b, driftOver(3.5, options), random);
    graph.add(ab);
    graph.add(bc);
    const auto estimates = graph.solve({here, 5.0});
    const PoseEstimate& c = estimates.at("c").T_odom_peerodom;
    const Eigen::Vector3d error(c.pose.x - truth.x, c.pose.y - truth.y, angleBetween(truth.yaw, c.pose.yaw));
    sum += error * error.transpose() / kTrials;
    said += c.covariance / kTrials;
  }
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(sum(i, i) / said(i, i), 1.0, 0.3) << i;
}

TEST(PoseGraph, anEdgeThatDisagreesIsLeftOut) {
  RelativeLocalizationOptions options;
  options.edge_travel = 1.0;
  PoseGraph graph(options, "a");
  for (int i = 0; i < 3; ++i) {
    graph.add(edgeOf("a", kOdomA, {1.0 + 2 * i, 1.0, 0.2}, "b", kOdomB, {0.5, -1.0 + 2 * i, 1.0}, 10.0 + i, 5.0 + 2 * i));
  }
  RelativeEdge wrong = edgeOf("a", kOdomA, {9.0, 1.0, 0.2}, "b", kOdomB, {0.5, 7.0, 1.0}, 14.0, 13.0);
  wrong.T_from_to.pose.x += 1.0;
  graph.add(wrong);
  EXPECT_EQ(graph.edges().size(), 4U);
  const Pose2 truth = kOdomA.inverse() * kOdomB, found = graph.solve({{9.0, 1.0, 0.2}, 13.0}).at("b").T_odom_peerodom.pose;
  EXPECT_NEAR((found.position() - truth.position()).norm(), 0.0, 1e-4);
}

TEST(PoseGraph, isBounded) {
  RelativeLocalizationOptions options;
  options.max_edges = 5;
  PoseGraph graph(options, "a");
  const RelativeEdge first = edgeOf("a", kOdomA, {}, "b", kOdomB, {}, 1.0, 0.0);
  graph.add(first);
  graph.add(first);
  EXPECT_EQ(graph.edges().size(), 1U);
  for (int i = 1; i < 20; ++i) graph.add(edgeOf("a", kOdomA, {}, "b", kOdomB, {}, 1.0 + i, 10.0 * i));
  EXPECT_EQ(graph.edges().size(), 5U);
  graph.add(edgeOf("b", kOdomB, {}, "d", kOdomC, {}, 3.0, 1.0));
  EXPECT_EQ(reversed(reversed(first)).T_odom_from, first.T_odom_from);
  EXPECT_TRUE(PoseGraph(options, "x").solve({}).empty());
}

}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

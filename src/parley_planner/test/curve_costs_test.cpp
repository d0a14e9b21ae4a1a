// SPDX-License-Identifier: BSD-3-Clause
// The terms of equation 1 of the paper: curve_variables, curve_costs, sample_terms with all that it counts.
#include "curve_costs.h"

#include <ceres/cost_function.h>
#include <ceres/jet.h>
#include <gtest/gtest.h>

#include <random>

#include "scenes.h"

namespace parley {
namespace {

using Eigen::Vector2d;
using Dual = ceres::Jet<double, 8>;

double uniform(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

Vector2d randomVector(std::mt19937& random, double reach) {
  return {uniform(random, -reach, reach), uniform(random, -reach, reach)};
}

FlatState randomState(std::mt19937& random) {
  return {Vector2d(5.0, 5.0) + randomVector(random, 3.0), randomVector(random, 2.0), randomVector(random, 3.0)};
}

TEST(CurveVariables, AreThoseOfTheCurve) {
  std::mt19937 random(1);
  for (int i = 0; i < 50; ++i) {
    const std::vector<FlatState> knots = {randomState(random), randomState(random), randomState(random)};
    const PiecewiseQuintic curve(knots, uniform(random, 1.0, 5.0));
    const CurveVariables variables = CurveVariables::of(knots, curve.duration());
    const PiecewiseQuintic back = variables.curve();
    ASSERT_NEAR(back.duration(), curve.duration(), 1e-9);
    const double h = 0.5 * curve.duration(), tau = uniform(random, 0.01, 0.99);
    Eigen::Matrix<double, 6, 2> ends;  // of the second piece
    for (Eigen::Index k = 0; k < 3; ++k) {
      for (Eigen::Index axis = 0; axis < 2; ++axis) {
        ends(k, axis) = variables.knots[0][static_cast<std::size_t>(2 * k + axis)];
        ends(3 + k, axis) = variables.knots[1][static_cast<std::size_t>(2 * k + axis)];
      }
    }
    const Eigen::Matrix<double, 4, 2> derivatives = derivativesAt(tau) * ends;
    const FlatState state = curve.at(h + tau * h);
    ASSERT_LT((derivatives.row(0).transpose() - state.position).norm(), 1e-9);
    ASSERT_LT((derivatives.row(1).transpose() / h - state.velocity).norm(), 1e-8);
    ASSERT_LT((derivatives.row(2).transpose() / (h * h) - state.acceleration).norm(), 1e-7);
    ASSERT_LT((derivatives.row(3).transpose() / (h * h * h) - curve.jerk(h + tau * h)).norm(), 1e-6);
    const double cost = (jerkRoot() * ends).squaredNorm() * std::pow(h, -5.0);
    const double exact = QuinticPiece::between(knots[1], knots[2], h).jerkCost();
    ASSERT_NEAR(cost / exact, 1.0, 1e-6);
  }
}

/// Biggest difference between automatic and numeric derivatives of a term, relative to 1 plus their size.
template <class Term>
double derivativeError(const Term& term, const std::array<double, 8>& values) {
  std::array<Dual, 8> duals;
  for (int i = 0; i < 8; ++i) duals[static_cast<std::size_t>(i)] = Dual(values[static_cast<std::size_t>(i)], i);
  const auto sampleOf = [](const auto& x) {
    using T = std::decay_t<decltype(x[0])>;
    return FlatSample<T>{{x[0], x[1]}, {x[2], x[3]}, {x[4], x[5]}, {x[6], x[7]}};
  };
  const Dual result = term(sampleOf(duals));
  EXPECT_NEAR(result.a, term(sampleOf(values)), 1e-12);
  double worst = 0.0;
  for (std::size_t i = 0; i < 8; ++i) {
    const double h = 1e-6;
    std::array<double, 8> before = values, after = values;
    before[i] -= h;
    after[i] += h;
    const double numeric = (term(sampleOf(after)) - term(sampleOf(before))) / (2.0 * h);
    worst = std::max(worst, std::abs(numeric - result.v[static_cast<Eigen::Index>(i)]) / (1.0 + std::abs(numeric)));
  }
  return worst;
}

/// A wall with a gap, a bent reference, a teammate: everything that a sample can be judged by.
class TermsTest : public testing::Test {
 protected:
  static World world() {
    World result(10, 10, false);
    result.fill(4.0, 0.0, 4.3, 4.4, true);
    result.fill(4.0, 5.6, 4.3, 10.0, true);
    return result;
  }
  static ReferencePath bent() {
    Path points;
    for (int i = 0; i <= 50; ++i) points.push_back({2.0 + 0.1 * i, 5.0 + 0.8 * std::sin(0.12 * i)});
    return ReferencePath(points);
  }
  std::array<double, 8> randomFlat() {
    const Vector2d p = Vector2d(4.5, 5.2) + randomVector(random_, 1.0), v = randomVector(random_, 2.0),
                   a = randomVector(random_, 3.0), j = randomVector(random_, 8.0);
    return {p.x(), p.y(), v.x(), v.y(), a.x(), a.y(), j.x(), j.y()};
  }
  /// Terms have kinks (cells of the field, hinges), and beside a corner of the path the nearest point stays where the terms
  /// take it to move on: nearly all states must agree.
  template <class Term>
  void expectDerivatives(const char* name, const Term& term) {
    int wrong = 0;
    for (int i = 0; i < 300; ++i) wrong += derivativeError(term, randomFlat()) > 1e-4 ? 1 : 0;
    EXPECT_LE(wrong, 12) << name;
  }
  std::mt19937 random_{5};
  Surroundings surroundings_{seenMap(world()), {}, {}, {}};
  ReferencePath reference_ = bent();
};

TEST_F(TermsTest, DerivativesAreThoseOfDifferences) {
  const Margins margins{0.3, 0.1, 0.2};
  const Polygon corners = robotFootprint().polygon();
  const PeerThere peer{robotFootprint().polygonAt({4.6, 5.3, 0.7}), 0.6};
  std::vector<double> bounds(reference_.points().size());
  for (std::size_t i = 0; i < bounds.size(); ++i) bounds[i] = 0.5 + 0.4 * std::sin(0.3 * static_cast<double>(i));
  const auto expect = [this](const char* name, const auto& term) { expectDerivatives(name, term); };
  const auto at = [&](const auto& x) { return offsetFrom(reference_, x.position, 2.5, 3.0); };
  expect("speed", [&](const auto& x) { return speedExcess(x, valueAlong(reference_, bounds, at(x).along)); });
  expect("turn rate", [](const auto& x) { return turnRateExcess(x, 0.4); });
  expect("acceleration", [](const auto& x) { return accelerationExcess(x, 0.5); });
  expect("turn acceleration", [](const auto& x) { return turnAccelerationExcess(x, 0.5); });
  expect("deviation", [&](const auto& x) { return at(x).lateral; });
  expect("margin", [&](const auto& x) {
    const auto middle = carried({0.2, 0.1}, x.position, headingOf(x, Vector2d::UnitX()));
    return marginLack(x, surroundings_.obstacles(), middle, 0.24, margins);
  });
  expect("push",
         [&](const auto& x) { return pushLack(x, surroundings_.obstacles(), valueAlong(reference_, bounds, at(x).along)); });
  expect("peer", [&](const auto& x) { return peerLack(x, headingOf(x, Vector2d::UnitX()), corners, peer); });
}

/// Biggest difference between a cost's derivatives and numeric ones, relative to 1 plus their size.
double costError(const ceres::CostFunction& cost, std::vector<std::vector<double>> blocks) {
  const auto n = static_cast<std::size_t>(cost.num_residuals());
  std::vector<const double*> parameters;
  std::vector<std::vector<double>> storage;
  std::vector<double*> jacobians;
  for (const std::vector<double>& block : blocks) {
    parameters.push_back(block.data());
    storage.emplace_back(n * block.size());
  }
  for (std::vector<double>& jacobian : storage) jacobians.push_back(jacobian.data());
  std::vector<double> residuals(n), after(n), before(n);
  EXPECT_TRUE(cost.Evaluate(parameters.data(), residuals.data(), jacobians.data()));
  double worst = 0.0;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    for (std::size_t k = 0; k < blocks[b].size(); ++k) {
      const double h = 1e-6, value = blocks[b][k];
      blocks[b][k] = value + h;
      EXPECT_TRUE(cost.Evaluate(parameters.data(), after.data(), nullptr));
      blocks[b][k] = value - h;
      EXPECT_TRUE(cost.Evaluate(parameters.data(), before.data(), nullptr));
      blocks[b][k] = value;
      for (std::size_t r = 0; r < n; ++r) {
        const double numeric = (after[r] - before[r]) / (2.0 * h);
        worst = std::max(worst, std::abs(numeric - storage[b][r * blocks[b].size() + k]) / (1.0 + std::abs(numeric)));
      }
    }
  }
  return worst;
}

TEST_F(TermsTest, WholeCostsHaveTheirDerivatives) {
  const DistanceField& field = surroundings_.obstacles();
  const SampleScene scene{
      reference_,      std::vector<double>(51, 0.7), std::vector<double>(51, 0.3), std::vector<double>(51, 0.6), field, field,
      {0.2, 0.1, 0.2}, {1.0, 0.8, 1.0, 2.0},         robotFootprint().polygon(),   {{-0.25, 0.0}, {0.25, 0.0}},  0.24};
  const TermWeights weights{1.0, 1.0, 1.0, 1.0, 1.0};
  int wrong = 0;
  for (int i = 0; i < 100; ++i) {
    CurveSample sample;
    sample.tau = uniform(random_, 0.05, 0.95);
    sample.near_s = 2.5;
    sample.peers.push_back({robotFootprint().polygonAt({4.6, 5.3, 0.7}), 0.4});
    const auto state = [this](double x) {
      return FlatState{Vector2d(x, 5.1) + randomVector(random_, 0.5), randomVector(random_, 1.0), randomVector(random_, 1.0)};
    };
    const FlatState start = state(4.0);
    const double log_duration = uniform(random_, -0.8, 0.3);
    const KnotBlock from = scaledKnot(start, std::exp(log_duration)), to = scaledKnot(state(4.8), std::exp(log_duration));
    const std::vector<double> last(to.begin(), to.end());
    for (const bool first : {false, true}) {
      std::vector<std::vector<double>> blocks = {last, {log_duration}};
      if (!first) blocks.insert(blocks.begin(), std::vector<double>(from.begin(), from.end()));
      const FlatState* fixed = first ? &start : nullptr;
      EXPECT_LT(costError(*makeJerkCost(fixed), blocks), 1e-5) << "case " << i;
      wrong += costError(*makeSampleCost(fixed, scene, sample, weights), blocks) > 1e-3 ? 1 : 0;
    }
  }
  EXPECT_LE(wrong, 10);  // of 200: kinks
  EXPECT_LT(costError(*makeTimeCost(5.0, 7), {{0.3}}), 1e-6);
}

TEST(SmoothPolygonDistance, IsNearTheTrueOne) {
  std::mt19937 random(3);
  int apart = 0;
  for (int i = 0; i < 2000; ++i) {
    const Polygon a = robotFootprint().polygonAt({0.0, 0.0, uniform(random, -kPi, kPi)});
    const Vector2d there = randomVector(random, 1.2);
    const Polygon b = Footprint{uniform(random, 0.3, 1.2), uniform(random, 0.3, 0.8)}.polygonAt(
        {there.x(), there.y(), uniform(random, -kPi, kPi)});
    const double exact = convexDistance(a, b), smooth = smoothPolygonDistance<double>(a, b, kPeerSharpness);
    ASSERT_LE(smooth, exact + 1e-9) << "case " << i;
    ASSERT_GT(smooth, 0.65 * exact - (exact > 0.0 ? 0.09 : 1.0)) << "case " << i;  // corner to corner it falls short
    if (exact == 0.0) {
      ASSERT_LT(smooth, 0.0) << "case " << i;
    }
    if (exact > 0.15) {
      ASSERT_GT(smooth, 0.0) << "case " << i;
      ++apart;
    }
  }
  EXPECT_GT(apart, 300);
}

TEST(SmoothPolygonDistance, GrowsOnTheWayApart) {
  const Polygon a = robotFootprint().polygonAt({0.0, 0.0, 0.4});
  double before = -1e9;
  for (double x = 0.05; x < 2.0; x += 0.05) {
    const double now = smoothPolygonDistance<double>(a, robotFootprint().polygonAt({x, 0.3 * x, -0.6}), kPeerSharpness);
    EXPECT_GT(now, before) << x;
    before = now;
  }
}

}  // namespace
}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

// SPDX-License-Identifier: BSD-3-Clause
#include "curve_costs.h"

#include <ceres/cost_function.h>
#include <ceres/jet.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace parley {

namespace {

constexpr int kFlat = 8;  // position and three derivatives, x and y in turn
using FlatVector = Eigen::Matrix<double, kFlat, 1>;
using Dual = ceres::Jet<double, kFlat>;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Block = Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;

template <class T>
FlatSample<T> sampleOf(const T* x) {
  return {{x[0], x[1]}, {x[2], x[3]}, {x[4], x[5]}, {x[6], x[7]}};
}

/// A cost of one piece. Residuals depend on the twelve scaled values of its ends, x and y in turn, and on the duration.
class PieceCost : public ceres::CostFunction {
 public:
  explicit PieceCost(const FlatState* start) {
    if (start != nullptr) start_ = *start;
    if (!start_) mutable_parameter_block_sizes()->push_back(6);
    mutable_parameter_block_sizes()->push_back(6);
    mutable_parameter_block_sizes()->push_back(1);
  }

 protected:
  using Ends = Eigen::Matrix<double, 12, 1>;

  static double logDuration(double const* const* parameters, bool first) { return parameters[first ? 1 : 2][0]; }
  bool first() const { return start_.has_value(); }

  Ends endsOf(double const* const* parameters) const {
    Ends ends;
    if (start_) {
      const KnotBlock from = scaledKnot(*start_, std::exp(parameters[1][0]));
      std::copy(from.begin(), from.end(), ends.data());
    } else {
      std::copy_n(parameters[0], 6, ends.data());
    }
    std::copy_n(parameters[first() ? 0 : 1], 6, ends.data() + 6);
    return ends;
  }

  /// Hands the derivatives with respect to the ends, and with respect to the duration alone, to the parameter blocks. A fixed
  /// start's scaled velocity grows with the duration, its scaled acceleration with the duration's square.
  void spread(const RowMajor& by_ends, Eigen::VectorXd by_duration, const Ends& ends, double** jacobians) const {
    const Eigen::Index n = by_ends.rows();
    const auto put = [&](double* target, const auto& values) {
      if (target != nullptr) Block(target, n, values.cols()) = values;
    };
    if (start_) {
      by_duration += by_ends.middleCols<2>(2) * ends.segment<2>(2) + 2.0 * by_ends.middleCols<2>(4) * ends.segment<2>(4);
    } else {
      put(jacobians[0], by_ends.leftCols<6>());
    }
    put(jacobians[first() ? 0 : 1], by_ends.rightCols<6>());
    put(jacobians[first() ? 1 : 2], by_duration);
  }

 private:
  std::optional<FlatState> start_;
};

class JerkCost final : public PieceCost {
 public:
  explicit JerkCost(const FlatState* start) : PieceCost(start) {
    set_num_residuals(6);
    const JerkRoot root = jerkRoot();
    map_.setZero();
    for (Eigen::Index i = 0; i < 3; ++i) {
      for (Eigen::Index k = 0; k < 6; ++k) map_(2 * i, 2 * k) = map_(2 * i + 1, 2 * k + 1) = root(i, k);
    }
  }

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const Ends ends = endsOf(parameters);
    const double scale = std::exp(-2.5 * logDuration(parameters, first()));
    Eigen::Map<Eigen::Matrix<double, 6, 1>> result(residuals);
    result = scale * (map_ * ends);
    if (jacobians != nullptr) spread(scale * map_, -2.5 * result, ends, jacobians);
    return true;
  }

 private:
  Eigen::Matrix<double, 6, 12> map_;
};

class TimeCost final : public ceres::CostFunction {
 public:
  TimeCost(double weight, std::size_t pieces) : scale_(std::sqrt(weight * static_cast<double>(pieces))) {
    set_num_residuals(1);
    mutable_parameter_block_sizes()->push_back(1);
  }

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    residuals[0] = scale_ * std::exp(0.5 * parameters[0][0]);
    if (jacobians != nullptr && jacobians[0] != nullptr) jacobians[0][0] = 0.5 * residuals[0];
    return true;
  }

 private:
  double scale_;
};

class SampleCost final : public PieceCost {
 public:
  SampleCost(const FlatState* start, const SampleScene& scene, const CurveSample& sample, const TermWeights& weights)
      : PieceCost(start), scene_(scene), sample_(sample), weights_(weights), rows_(derivativesAt(sample.tau)) {
    set_num_residuals(static_cast<int>(sample.residualCount(scene)));
  }

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const Ends ends = endsOf(parameters);
    const double rate = std::exp(-logDuration(parameters, first()));
    Eigen::Matrix<double, kFlat, 12> map = Eigen::Matrix<double, kFlat, 12>::Zero();
    double scale = 1.0;
    for (Eigen::Index k = 0; k < 4; ++k, scale *= rate) {
      for (Eigen::Index i = 0; i < 6; ++i) map(2 * k, 2 * i) = map(2 * k + 1, 2 * i + 1) = scale * rows_(k, i);
    }
    const FlatVector x = map * ends;
    if (jacobians == nullptr) {
      evaluateSample(scene_, sample_, weights_, sampleOf(x.data()), residuals);
      return true;
    }
    evaluateWithDerivatives(x, map, ends, residuals, jacobians);
    return true;
  }

 private:
  void evaluateWithDerivatives(const FlatVector& x, const Eigen::Matrix<double, kFlat, 12>& map, const Ends& ends,
                               double* residuals, double** jacobians) const {
    std::array<Dual, kFlat> duals;
    for (int i = 0; i < kFlat; ++i) duals[static_cast<std::size_t>(i)] = Dual(x[i], i);
    std::vector<Dual> results(static_cast<std::size_t>(num_residuals()));
    evaluateSample(scene_, sample_, weights_, sampleOf(duals.data()), results.data());
    Eigen::Matrix<double, Eigen::Dynamic, kFlat, Eigen::RowMajor> by_flat(num_residuals(), kFlat);
    for (std::size_t i = 0; i < results.size(); ++i) {
      residuals[i] = results[i].a;
      by_flat.row(static_cast<Eigen::Index>(i)) = results[i].v.transpose();
    }
    FlatVector by_rate;  // the k-th derivative falls with the k-th power of the duration
    by_rate << 0.0, 0.0, -x.segment<2>(2), -2.0 * x.segment<2>(4), -3.0 * x.segment<2>(6);
    spread(by_flat * map, by_flat * by_rate, ends, jacobians);
  }

  const SampleScene& scene_;
  const CurveSample& sample_;
  const TermWeights& weights_;
  DerivativeRows rows_;
};

}  // namespace

std::unique_ptr<ceres::CostFunction> makeJerkCost(const FlatState* start) { return std::make_unique<JerkCost>(start); }

std::unique_ptr<ceres::CostFunction> makeTimeCost(double weight, std::size_t pieces) {
  return std::make_unique<TimeCost>(weight, pieces);
}

std::unique_ptr<ceres::CostFunction> makeSampleCost(const FlatState* start, const SampleScene& scene, const CurveSample& sample,
                                                    const TermWeights& weights) {
  return std::make_unique<SampleCost>(start, scene, sample, weights);
}

}  // namespace parley

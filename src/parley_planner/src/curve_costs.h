// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>

#include "curve_variables.h"
#include "sample_terms.h"

namespace ceres {
class CostFunction;
}

namespace parley {

/// Cost functions of the variables of one piece: its scaled knots and the logarithm of its duration. The first piece has the
/// fixed state `start` instead of its first knot: parameters are [knot before,] knot after, log duration. Sum of squares counts.

/// The integral of squared jerk over the piece. `start`: null but for the first piece.
std::unique_ptr<ceres::CostFunction> makeJerkCost(const FlatState* start);
/// `weight` times the duration of all `pieces`, a function of the log duration alone.
std::unique_ptr<ceres::CostFunction> makeTimeCost(double weight, std::size_t pieces);
/// The penalties at one sample. Scene, sample and weights must outlive it.
std::unique_ptr<ceres::CostFunction> makeSampleCost(const FlatState* start, const SampleScene& scene, const CurveSample& sample,
                                                    const TermWeights& weights);

}  // namespace parley

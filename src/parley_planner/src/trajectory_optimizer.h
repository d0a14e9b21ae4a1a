// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "drive_generator.h"
#include "parley_geometry/piecewise_quintic.h"
#include "parley_planner/planner_options.h"
#include "sample_terms.h"

namespace parley {

struct OptimizerOptions {
  TermWeights weights;
  int iterations;               // [-] at most
  double piece_duration = 0.5;  // [s] about that of a piece at the beginning
  int most_pieces = 8;          // [-] longer drives have longer pieces
  int samples = 5;              // [-] on a piece
};

OptimizerOptions optimizerOptions(const PlannerOptions& options);

/// What a drive is made better in.
struct OptimizationTask {
  const ReferencePath& reference;             // that the drive follows
  const std::vector<TrajectoryPoint>& drive;  // to begin with; its first state and its last position are kept
  const std::vector<double>& sight_bounds;    // [m/s] at each of the reference's points; may be empty
  const std::vector<double>& sight_slopes;    // [1/s] by which they grow per metre to the left; may be empty
  const DriveScene& scene;
  Margins margins;
  const DistanceField& shape;  // what pushes paths away
  double push_distance;        // [m] to be kept from it, unless the reference keeps less
};

/// Equation 1 of the paper: the piecewise quintic of least squared jerk, weighted time and penalties for obstacles, limits and
/// teammates, as non-linear least squares from a simulated drive on. What it returns breaks limits where that pays: it is
/// the shape of a path, not to be driven as it is. Iterations are counted, not timed: same inputs, same bits.
class TrajectoryOptimizer {
 public:
  /// `limits`: what plans may use.
  TrajectoryOptimizer(const OptimizerOptions& options, const Footprint& footprint, const MotionLimits& limits);

  /// Nullopt for drives of less than half a second or half a metre, and where no better curve is found.
  std::optional<PiecewiseQuintic> optimized(const OptimizationTask& task) const;

 private:
  std::vector<CurveSample> samplesOf(const OptimizationTask& task, const SampledTrajectory& drive, std::size_t pieces) const;
  SampleScene sceneOf(const OptimizationTask& task) const;

  OptimizerOptions options_;
  Footprint footprint_;
  MotionLimits limits_;
};

}  // namespace parley

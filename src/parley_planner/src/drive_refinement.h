// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "manoeuvre_task.h"
#include "trajectory_optimizer.h"

namespace parley {

/// A path, how fast sight allows to drive on it, and the simulated drive along it.
struct DrivenPath {
  ReferencePath path;
  std::vector<double> sight_bounds;  // [m/s] at each of the path's points; may be empty
  GeneratedDrive drive;
};

/// Makes forward drives faster: optimises their curve (equation 1 of the paper) and drives it in simulation as any path, so that
/// limits and margins hold by construction. The new drive is taken only if nothing about it is worse.
class DriveRefinement {
 public:
  DriveRefinement(const OptimizerOptions& options, const Footprint& footprint, const MotionLimits& limits);

  /// The better drive from the same start, if there is one. Its advance is measured along `initial`'s path.
  std::optional<DrivenPath> refined(const ManoeuvreTask& task, const DrivenPath& initial, const DriveGenerator& generator) const;

 private:
  TrajectoryOptimizer optimizer_;
};

/// The path of a curve, a point each 0.1 m, which begins a little behind its start, as `smoothed` does, and goes on beyond its
/// end as `reference` does from its arc length `end_s` [m] on. Nullopt if the curve turns back on itself.
std::optional<ReferencePath> pathOf(const PiecewiseQuintic& curve, const PathStart& start, const ReferencePath& reference,
                                    double end_s);

/// Whether `path` keeps its distance: where it comes nearer to what pushes paths away than `push_distance` [m], it comes no
/// nearer than `reference` does beside, 0.02 m apart.
bool keepsDistance(const ReferencePath& path, const ReferencePath& reference, const DistanceField& shape, double push_distance);

/// Integral of the squared jerk of a simulated drive, from its states' differences. [m^2/s^5]
double squaredJerk(const std::vector<TrajectoryPoint>& points);

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "point_index.h"
#include "pose_information.h"

namespace parley {

/// Result of a refinement: pose of the source's odom frame in the target's, with what the surfaces say of it.
struct ScanMatch {
  bool converged = false;
  PoseInformation estimate;  // T_target_source; all directions, also those hardly observed
  Observability observability;
  int inliers = 0;        // [-] source points that found a surface
  double residual = 0.0;  // [m] root mean square distance of the inliers from their lines
};

/// Refines a pose by point-to-line ICP with Tukey weights; correspondences shrink from a wide to a narrow gate.
/// Correlated errors (odometry inside the submaps, quantisation) keep the covariance above a floor.
/// `prior` joins in with its information.
ScanMatch refineMatch(const PointIndex& target, const std::vector<SurfacePoint>& source, const PoseInformation& prior,
                      int iterations = 15);

}  // namespace parley

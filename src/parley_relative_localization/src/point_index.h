// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "submap.h"

namespace parley {

/// Nearest surface point within a reach, by a grid of buckets.
class PointIndex {
 public:
  /// `cell` [m] is the largest reach that nearest() may be asked for.
  PointIndex(std::vector<SurfacePoint> points, double cell);

  /// nullptr if there is none within `reach` [m] whose normal is less than 45 degrees from `normal`.
  const SurfacePoint* nearest(const Eigen::Vector2d& position, const Eigen::Vector2d& normal, double reach) const;
  const std::vector<SurfacePoint>& points() const { return points_; }

 private:
  long cellOf(double value, double origin) const;

  double cell_;                                    // [m]
  Eigen::Vector2d low_ = Eigen::Vector2d::Zero();  // [m]
  long columns_ = 0, rows_ = 0;                    // [-]
  std::vector<SurfacePoint> points_;               // by bucket
  std::vector<std::size_t> starts_;                // first point of each bucket, and one past the last
};

}  // namespace parley

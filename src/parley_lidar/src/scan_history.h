// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>

#include "binned_scan.h"
#include "parley_geometry/pose2.h"

namespace parley {

/// What one scan saw, as it was measured, with where it was taken.
struct PastScan {
  double stamp = 0.0;  // [s]
  Pose2 T_odom_base;
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();  // [m] of the lidar, base frame
  double range_max = 0.0;                            // [m]
  int beam_width = 1;                                // [bins]
  std::vector<float> ranges;                         // [m] as in BinnedScan

  /// How far the view goes in every bin within `half_angle` [rad] of a place: the least of them, 0 where one was not
  /// looked at. [m]
  double viewToward(const Eigen::Vector2d& p_odom, double half_angle) const;
  double distanceTo(const Eigen::Vector2d& p_odom) const;
  /// Whether something was met within `radius` [m] of a place.
  bool hasReturnNear(const Eigen::Vector2d& p_odom, double radius) const;
};

/// Scans of the last moments, oldest first: at most `horizon` seconds and 40 of them.
class ScanHistory {
 public:
  explicit ScanHistory(double horizon) : horizon_(horizon) {}

  void add(const BinnedScan& scan, double stamp, const Pose2& T_odom_base);
  const std::deque<PastScan>& scans() const { return scans_; }
  void clear() { scans_.clear(); }

 private:
  double horizon_;
  std::deque<PastScan> scans_;
};

}  // namespace parley

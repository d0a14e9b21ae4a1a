// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "parley_geometry/pose2.h"
#include "parley_relative_localization/scan_descriptor.h"

namespace parley {

/// A scan and where it was taken, in its robot's odom frame.
struct PlacedScan {
  int id = 0;          // [-]
  double stamp = 0.0;  // [s]
  Pose2 T_odom_scan;
  PolarScan scan;
};

/// A point on a surface. The normal points to where it was seen from; zero where the surface has no direction.
struct SurfacePoint {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // [m]
  Eigen::Vector2d normal = Eigen::Vector2d::Zero();    // [-]
};

/// What a scan says of a point.
enum class Sighting { kNothing, kMatch, kSeenThrough };

/// Of a point in the scan's frame. Match: the scan's surface is there. Seen through: it looked on behind the point, by the
/// neighbouring bins too.
Sighting sightOf(const PolarScan& scan, const Eigen::Vector2d& p_scan, double margin = 0.0);

/// From an odom frame into that of a scan, without working out the angle for every point.
class IntoScan {
 public:
  explicit IntoScan(const Pose2& T_odom_scan)
      : rotation_(Eigen::Rotation2Dd(-T_odom_scan.yaw).toRotationMatrix()), origin_(T_odom_scan.position()) {}
  Eigen::Vector2d operator*(const Eigen::Vector2d& p_odom) const { return rotation_ * (p_odom - origin_); }

 private:
  Eigen::Matrix2d rotation_;
  Eigen::Vector2d origin_;
};

/// Scans of one robot in its odom frame, without the points that another of the scans saw through and none saw again:
/// what moves, another robot above all.
class Submap {
 public:
  explicit Submap(std::vector<PlacedScan> scans);

  const std::vector<PlacedScan>& scans() const { return scans_; }
  const std::vector<SurfacePoint>& points() const { return points_; }
  /// What scan `i` says of a point in the odom frame.
  Sighting sight(std::size_t i, const Eigen::Vector2d& p_odom, double margin = 0.0) const {
    return sightOf(scans_[i].scan, into_scans_[i] * p_odom, margin);
  }
  /// Evenly at most `count` of the points that have a normal.
  std::vector<SurfacePoint> sample(std::size_t count) const;

 private:
  bool isContradicted(const Eigen::Vector2d& point, std::size_t own_scan) const;

  std::vector<PlacedScan> scans_;
  std::vector<IntoScan> into_scans_;
  std::vector<SurfacePoint> points_;
};

}  // namespace parley

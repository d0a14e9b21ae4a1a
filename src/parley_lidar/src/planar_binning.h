// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "binned_scan.h"
#include "parley_geometry/footprint.h"
#include "parley_geometry/scan.h"
#include "scan_motion.h"

namespace parley {

/// Why a planar scan cannot be one; empty if it can. The stamp is not looked at.
std::string planarProblem(const RangeScan& scan, const LidarOptions& options);

/// From first to last beam. [s]
double durationOf(const RangeScan& scan);

/// Sorts a planar lidar's beams by bearing, without those on the robot itself or on the floor.
class PlanarBinning {
 public:
  PlanarBinning(const LidarOptions& options, const Footprint& footprint, const LidarMount& mount);

  /// The scan must have no problem.
  BinnedScan bin(const RangeScan& scan, const ScanMotion& motion);

 private:
  struct Beam {
    Eigen::Vector3f direction_lidar;
    Eigen::Vector2f direction_base;
    float self_range;  // [m] nearer returns are of the robot itself
    double bearing;    // [rad] while the robot stands level
    BinSpan span;      // of that bearing
  };
  struct Reading {
    bool valid = false;  // it says anything
    bool own = false;    // it is of the robot itself
    bool hit = false;
    float range = 0.0F;  // [m]
  };

  /// The table of beams depends on the lidar's geometry alone, which seldom changes.
  void prepareBeams(const RangeScan& scan);
  Beam beamAt(double angle) const;
  Reading read(const RangeScan& scan, std::size_t index) const;
  BinnedScan withStillBeams(BinnedScan binned, const std::vector<Reading>& readings) const;
  BinnedScan withMovingBeams(BinnedScan binned, const std::vector<Reading>& readings, const ScanMotion& motion,
                             double time_increment) const;
  bool isInBand(float height) const;

  LidarOptions options_;
  Footprint footprint_;
  LidarMount mount_;
  BearingBins bins_;
  double angle_min_ = 0.0;        // [rad]
  double angle_increment_ = 0.0;  // [rad]
  std::vector<Beam> beams_;
};

}  // namespace parley

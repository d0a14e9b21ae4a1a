// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace parley {

/// Equal sectors of bearing, counter-clockwise from -pi.
class BearingBins {
 public:
  explicit BearingBins(int count);

  int count() const { return count_; }
  double width() const { return width_; }  // [rad]
  /// The bin of a bearing in [-2 pi, 2 pi].
  int of(double bearing) const;
  /// The bin of an index that has run over either end, once at most.
  int wrap(int bin) const { return bin < 0 ? bin + count_ : bin >= count_ ? bin - count_ : bin; }

 private:
  int count_;
  double width_;
};

/// Neighbouring bins that one beam speaks for.
struct BinSpan {
  int first = 0;  // wrapped
  int count = 0;
};

/// The bins whose centres are within half a beam of the bearing, and the one it falls in. Beams side by side share no
/// bin unless they are closer together than bins, and leave none out.
BinSpan binsOfBeam(const BearingBins& bins, double bearing, double beam_width);

struct ObstaclePoint {
  Eigen::Vector2f position = Eigen::Vector2f::Zero();  // [m] base frame at the end of the scan
  float range = 0.0F;                                  // [m]
  int bin = 0;
};

/// A reading sorted by bearing about the lidar, in the axes of the base frame at the end of the scan.
struct BinnedScan {
  explicit BinnedScan(int bins = 0);

  /// A ray in this bin met nothing.
  void addFree(int bin);
  /// A ray in this bin met an obstacle. `beam` tells bins apart that saw it from bins that one beam was spread over.
  void addHit(int bin, float range, int beam);

  double range_max = 0.0;                            // [m]
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();  // [m] of the lidar
  std::vector<float> ranges;                         // [m] nearest hit, +inf free, NaN not looked at
  std::vector<float> next_ranges;                    // [m] second nearest hit, +inf if there is none
  std::vector<int> beams;                            // [-] that made the nearest hit, -1 if there is none
  int beam_width = 1;                                // [bins] that a beam is wide, rounded up
  std::vector<ObstaclePoint> points;                 // every hit
  int valid = 0;                                     // [-] readings that said anything
  int dropped = 0;                                   // [-] readings that could not be
};

}  // namespace parley

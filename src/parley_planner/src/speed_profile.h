// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "parley_geometry/motion.h"
#include "reference_path.h"

namespace parley {

/// The highest speed at each arc length of a path from which all that comes after can still be obeyed.
class SpeedProfile {
 public:
  /// The drive's limits along the path: speed, turn rate and turn acceleration on its curvature.
  SpeedProfile(const ReferencePath& path, const MotionLimits& limits);

  std::size_t size() const { return bounds_.size(); }
  const std::vector<double>& arcLengths() const { return arc_lengths_; }
  /// [m/s] before braking is thought of.
  double bound(std::size_t i) const { return bounds_[i]; }
  /// Not faster than `speed` [m/s] at the i-th point.
  void lower(std::size_t i, double speed);
  /// Not faster than `speed` between two arc lengths [m].
  void lowerBetween(double from, double to, double speed);
  /// Standing at `s` [m] and after.
  void stopAt(double s);
  double stop() const { return stop_; }
  /// Spreads the bounds backwards by the braking deceleration. Call after the last change.
  void spread();
  /// [m/s] after spreading; 0 from the stop on.
  double at(double s) const;

 private:
  std::vector<double> arc_lengths_;  // [m]
  std::vector<double> bounds_;       // [m/s]
  std::vector<double> squares_;      // [m^2/s^2] after spreading
  double stop_;                      // [m]
  double braking_;                   // [m/s^2]
};

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "path_search.h"

namespace parley {

/// A smooth path to be tracked, with its direction and curvature at every point.
class ReferencePath {
 public:
  struct Point {
    Eigen::Vector2d position = Eigen::Vector2d::Zero();  // [m]
    double yaw = 0.0;                                    // [rad] of the tangent
    double curvature = 0.0;                              // [1/m] positive to the left
  };

  ReferencePath() = default;
  /// At least two points, no two neighbours alike.
  explicit ReferencePath(Path points);

  bool empty() const { return points_.empty(); }
  const Path& points() const { return points_; }
  const std::vector<double>& arcLengths() const { return arc_lengths_; }
  double length() const { return arc_lengths_.back(); }
  /// State at an arc length [m], clamped to the ends.
  Point at(double s) const;
  /// Arc length [m] of the nearest point of the path not further than `reach` [m] along it from `near_s`.
  double project(const Eigen::Vector2d& p, double near_s, double reach) const;

 private:
  std::size_t segmentAt(double s) const;

  Path points_;
  std::vector<double> arc_lengths_, yaws_, curvatures_;
};

/// How a robot enters a path.
struct PathStart {
  Pose2 pose;              // yaw is that of the motion: turned by pi when reversing
  double speed = 0.0;      // [m/s] along the motion, not negative
  double turn_rate = 0.0;  // [rad/s]
};

/// Points of the curve that brought the robot to the start, `spacing` [m] apart, and the start: what follows bends on from them.
Path leadIn(const PathStart& start, double spacing);

struct SmoothingOptions {
  double spacing = 0.1;             // [m] between points
  double push_distance = 0.4;       // [m] obstacles nearer than this push the path away
  double bending_weight = 60.0;     // [-] against a push of one
  double twisting_weight = 2000.0;  // [-] against change of curvature
  double tension_weight = 0.3;      // [-]
  int iterations = 10;              // [-]
};

/// Elastic band: least bending energy against the push of near obstacles, by Gauss-Newton steps. Begins a
/// little behind the start, on the curve that is being driven, and ends where the path ends.
ReferencePath smoothed(const Path& path, const PathStart& start, const DistanceField& obstacles, const SmoothingOptions& options);

}  // namespace parley

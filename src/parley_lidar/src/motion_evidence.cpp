// SPDX-License-Identifier: BSD-3-Clause
#include "motion_evidence.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "parley_geometry/angles.h"

namespace parley {
namespace {

constexpr double kPadding = 0.03;  // [m] beside a ray: a beam's own width, and a blob's edge between two beams

/// What odometry may have got wrong between two scans.
struct OdometryError {
  double distance = 0.0;  // [m]
  double angle = 0.0;     // [rad]
};

OdometryError errorBetween(const PastScan& a, const PastScan& b, double share) {
  const double travel = (a.T_odom_base.position() - b.T_odom_base.position()).norm();
  return {share * travel, share * std::abs(angleBetween(a.T_odom_base.yaw, b.T_odom_base.yaw))};
}

bool isSeenThrough(const Eigen::Vector2d& point, const PastScan& scan, const OdometryError& error, const LidarOptions& options) {
  const double beam = scan.beam_width * 2.0 * kPi / static_cast<double>(scan.ranges.size());
  const double distance = scan.distanceTo(point);
  const double beyond = distance + options.moving_margin + error.distance;
  if (beyond >= scan.range_max || distance * beam > options.moving_resolution) return false;
  const double half_angle = beam + error.angle + (kPadding + error.distance) / std::max(distance, kPadding);
  return scan.viewToward(point, half_angle) > beyond;
}

}  // namespace

int motionEvidence(const Sighting& before, const Sighting& now, const ScanHistory& history, const LidarOptions& options) {
  const auto& scans = history.scans();
  const auto then = std::find_if(scans.begin(), scans.end(), [&](const PastScan& s) { return s.stamp == before.stamp; });
  if (then == scans.end()) return 0;
  const PastScan& newest = scans.back();
  const OdometryError error = errorBetween(*then, newest, options.odometry_error);
  const auto count = [&](const std::vector<Eigen::Vector2d>& points, const PastScan& scan) {
    return static_cast<int>(std::count_if(
        points.begin(), points.end(), [&](const Eigen::Vector2d& point) { return isSeenThrough(point, scan, error, options); }));
  };
  int new_points = count(now.points, *then);
  // Something thin can slip between the beams of one scan, less likely of two.
  if (then != scans.begin()) new_points = std::min(new_points, count(now.points, *std::prev(then)));
  return count(before.points, newest) + new_points;
}

bool hasMoved(const Track& track, const ScanHistory& history, const LidarOptions& options) {
  if (track.object().observations < options.moving_observations) return false;
  const Sighting& now = track.sightings().back();
  return std::any_of(track.sightings().begin(), std::prev(track.sightings().end()), [&](const Sighting& before) {
    const double displacement = (now.middle - before.middle).norm();
    if (displacement < options.moving_displacement) return false;
    if (displacement < options.moving_speed * (now.stamp - before.stamp)) return false;
    return motionEvidence(before, now, history, options) >= options.moving_evidence;
  });
}

}  // namespace parley

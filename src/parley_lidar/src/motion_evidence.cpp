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

int countSeenThrough(const Sighting& sighting, const PastScan& scan, const OdometryError& error, double margin) {
  const double beam = scan.beam_width * 2.0 * kPi / static_cast<double>(scan.ranges.size());
  return static_cast<int>(std::count_if(sighting.points.begin(), sighting.points.end(), [&](const Eigen::Vector2d& point) {
    const double distance = scan.distanceTo(point);
    if (distance + margin + error.distance >= scan.range_max) return false;
    const double half_angle = beam + error.angle + (kPadding + error.distance) / std::max(distance, kPadding);
    return scan.viewToward(point, half_angle) > distance + margin + error.distance;
  }));
}

}  // namespace

int motionEvidence(const Sighting& before, const PastScan& scan_before, const Sighting& now, const PastScan& scan_now,
                   const LidarOptions& options) {
  const OdometryError error = errorBetween(scan_before, scan_now, options.odometry_error);
  return countSeenThrough(before, scan_now, error, options.moving_margin) +
         countSeenThrough(now, scan_before, error, options.moving_margin);
}

bool hasMoved(const Track& track, const ScanHistory& history, const LidarOptions& options) {
  if (track.object().observations < options.moving_observations) return false;
  const Sighting& now = track.sightings().back();
  const auto& scans = history.scans();
  return std::any_of(track.sightings().begin(), std::prev(track.sightings().end()), [&](const Sighting& before) {
    const double displacement = (now.middle - before.middle).norm();
    if (displacement < options.moving_displacement) return false;
    if (displacement < options.moving_speed * (now.stamp - before.stamp)) return false;
    const auto then = std::find_if(scans.begin(), scans.end(), [&](const PastScan& s) { return s.stamp == before.stamp; });
    if (then == scans.end()) return false;
    return motionEvidence(before, *then, now, scans.back(), options) >= options.moving_evidence;
  });
}

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#include "scan_history.h"

#include <algorithm>
#include <cmath>

namespace parley {
namespace {

constexpr std::size_t kMaxScans = 40;
constexpr double kRound = 1e-9;  // [s]

struct Sight {
  double distance = 0.0;  // [m]
  double bearing = 0.0;   // [rad]
};

Sight sightOf(const PastScan& scan, const Eigen::Vector2d& p_odom) {
  const Eigen::Vector2d ray = scan.T_odom_base.inverse() * p_odom - scan.origin;
  return {ray.norm(), std::atan2(ray.y(), ray.x())};
}

}  // namespace

double PastScan::distanceTo(const Eigen::Vector2d& p_odom) const { return sightOf(*this, p_odom).distance; }

double PastScan::viewToward(const Eigen::Vector2d& p_odom, double half_angle) const {
  const BearingBins bins(static_cast<int>(ranges.size()));
  const double bearing = sightOf(*this, p_odom).bearing;
  const double reach = std::min(half_angle, 0.5 * kPi);
  const int first = bins.of(bearing - reach), last = bins.of(bearing + reach);
  double view = range_max;
  for (int bin = first;; bin = bins.wrap(bin + 1)) {
    const auto range = static_cast<double>(ranges[static_cast<std::size_t>(bin)]);
    if (std::isnan(range)) return 0.0;
    view = std::min(view, range);
    if (bin == last) return view;
  }
}

bool PastScan::hasReturnNear(const Eigen::Vector2d& p_odom, double radius) const {
  const BearingBins bins(static_cast<int>(ranges.size()));
  const Sight sight = sightOf(*this, p_odom);
  const double reach = sight.distance > radius ? std::asin(radius / sight.distance) : 0.5 * kPi;
  const int first = bins.of(sight.bearing - reach), last = bins.of(sight.bearing + reach);
  for (int bin = first;; bin = bins.wrap(bin + 1)) {
    const double range = ranges[static_cast<std::size_t>(bin)];
    if (std::isfinite(range) && std::abs(range - sight.distance) <= radius) return true;
    if (bin == last) return false;
  }
}

void ScanHistory::add(const BinnedScan& scan, double stamp, const Pose2& T_odom_base) {
  scans_.push_back({stamp, T_odom_base, scan.origin, scan.range_max, scan.beam_width, scan.ranges});
  while (scans_.size() > kMaxScans || scans_.front().stamp < stamp - horizon_ - kRound) scans_.pop_front();
}

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#include "outlier_removal.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace parley {
namespace {

constexpr double kGrazing = 0.0872;  // sine of 5 degrees: a wall met at this angle is still seen as one
constexpr double kRound = 1e-9;      // [s]

/// Distance between two returns `angle` [rad] apart. [m]
double gap(double range_a, double range_b, double angle) {
  return std::sqrt(std::max(0.0, range_a * range_a + range_b * range_b - 2.0 * range_a * range_b * std::cos(angle)));
}

bool hasCompany(const BinnedScan& scan, const BearingBins& bins, int bin, double distance) {
  const auto i = static_cast<std::size_t>(bin);
  const double range = scan.ranges[i];
  if (scan.next_ranges[i] - range <= distance) return true;
  // Returns from a wall met at a shallow angle lie far apart and are not alone for it.
  const double allowed = distance + range * scan.beam_width * bins.width() / kGrazing;
  for (int step = 1; step <= scan.beam_width + 1; ++step) {
    for (const int side : {-step, step}) {
      const auto j = static_cast<std::size_t>(bins.wrap(bin + side));
      if (scan.beams[j] < 0 || scan.beams[j] == scan.beams[i]) continue;
      if (gap(range, scan.ranges[j], step * bins.width()) <= allowed) return true;
    }
  }
  return false;
}

bool wasSeenBefore(const Eigen::Vector2d& p_odom, const ScanHistory& history, double oldest, double distance) {
  return std::any_of(history.scans().begin(), history.scans().end(),
                     [&](const PastScan& past) { return past.stamp >= oldest && past.hasReturnNear(p_odom, distance); });
}

}  // namespace

BinnedScan withoutOutliers(BinnedScan scan, const Pose2& T_odom_base, const ScanHistory& history, double stamp, double distance,
                           double memory) {
  const BearingBins bins(static_cast<int>(scan.ranges.size()));
  std::vector<int> alone;
  for (int bin = 0; bin < bins.count(); ++bin) {
    const auto i = static_cast<std::size_t>(bin);
    if (scan.beams[i] < 0 || hasCompany(scan, bins, bin, distance)) continue;
    const double bearing = -kPi + (bin + 0.5) * bins.width();
    const Eigen::Vector2d p_base = scan.origin + scan.ranges[i] * Eigen::Vector2d(std::cos(bearing), std::sin(bearing));
    if (!wasSeenBefore(T_odom_base * p_base, history, stamp - memory - kRound, distance)) alone.push_back(bin);
  }
  for (const int bin : alone) {
    const auto i = static_cast<std::size_t>(bin);
    const bool another = std::isfinite(scan.next_ranges[i]);
    scan.ranges[i] = another ? scan.next_ranges[i] : std::numeric_limits<float>::quiet_NaN();
    scan.beams[i] = another ? scan.beams[i] : -1;
    ++scan.dropped;
  }
  const auto is_out = [&](const ObstaclePoint& p) { return !(p.range >= scan.ranges[static_cast<std::size_t>(p.bin)]); };
  if (!alone.empty()) scan.points.erase(std::remove_if(scan.points.begin(), scan.points.end(), is_out), scan.points.end());
  return scan;
}

}  // namespace parley

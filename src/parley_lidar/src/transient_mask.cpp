// SPDX-License-Identifier: BSD-3-Clause
#include "transient_mask.h"

#include <algorithm>
#include <cmath>

#include "binned_scan.h"

namespace parley {

/// Looks at no more bins than a disc covers as seen from the lidar.
template <class Predicate>
int TransientMask::addWhere(const Eigen::Vector2d& center_base, double radius, const Predicate& is_on) {
  const BearingBins bins(static_cast<int>(scan_.binCount()));
  const Eigen::Vector2d ray = center_base - scan_.origin;
  const double distance = ray.norm();
  const double bearing = std::atan2(ray.y(), ray.x());
  const double reach = distance > radius ? std::asin(radius / distance) : kPi;
  const int count = std::min(bins.count(), static_cast<int>(2.0 * reach / bins.width()) + 3);
  int bin = bins.of(wrapAngle(bearing - reach - bins.width()));
  int picked = 0;
  for (int i = 0; i < count; ++i, bin = bins.wrap(bin + 1)) {
    const auto k = static_cast<std::size_t>(bin);
    if (bins_[k] || !std::isfinite(scan_.ranges[k]) || !is_on(scan_.pointAt(k, scan_.ranges[k]))) continue;
    bins_[k] = true;
    ++picked;
  }
  return picked;
}

void TransientMask::addDisc(const Eigen::Vector2d& center_base, double radius) {
  addWhere(center_base, radius, [&](const Eigen::Vector2d& p) { return (p - center_base).norm() <= radius; });
}

int TransientMask::addFootprint(const Pose2& T_base_other, const Footprint& footprint, double margin) {
  const Pose2 T_other_base = T_base_other.inverse();
  const double radius = footprint.circumscribedRadius() + 1.5 * margin;
  return addWhere(T_base_other.position(), radius,
                  [&](const Eigen::Vector2d& p) { return footprint.contains(T_other_base * p, margin); });
}

}  // namespace parley

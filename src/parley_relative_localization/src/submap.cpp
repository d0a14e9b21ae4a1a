// SPDX-License-Identifier: BSD-3-Clause
#include "submap.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace parley {
namespace {

constexpr double kSameRange = 0.08;    // [m] a range that agrees
constexpr double kRangeShare = 0.015;  // [-] and this share of the range on top
constexpr double kSeenThrough = 0.25;  // [m] a range that goes on this far behind
constexpr double kSurfaceJump = 0.25;  // [m] neighbouring bins farther apart are on two surfaces
constexpr int kNormalReach = 5;        // [-] bins on each side that a normal is drawn through
constexpr double kStraight = 0.45;     // [-] of what is no line the smaller extent over the larger is more

Eigen::Vector2d pointOf(const PolarScan& scan, int bin) {
  const double bearing = PolarScan::bearingOf(bin);
  return scan.rangeAt(bin) * Eigen::Vector2d(std::cos(bearing), std::sin(bearing));
}

/// Principal direction of the bins about this one on the same surface; zero where they are no line.
Eigen::Vector2d normalAt(const PolarScan& scan, int bin) {
  Eigen::Vector2d sum = pointOf(scan, bin);
  std::vector<Eigen::Vector2d> points{sum};
  for (const int side : {-1, 1}) {
    double range = scan.rangeAt(bin);
    for (int step = 1; step <= kNormalReach; ++step) {
      const int other = PolarScan::wrapBin(bin + side * step);
      if (!scan.isHit(other) || std::abs(scan.rangeAt(other) - range) > kSurfaceJump) break;
      range = scan.rangeAt(other);
      points.push_back(pointOf(scan, other));
      sum += points.back();
    }
  }
  if (points.size() < 4) return Eigen::Vector2d::Zero();
  const Eigen::Vector2d mean = sum / static_cast<double>(points.size());
  double xx = 0.0, xy = 0.0, yy = 0.0;
  for (const Eigen::Vector2d& point : points) {
    const Eigen::Vector2d d = point - mean;
    xx += d.x() * d.x();
    xy += d.x() * d.y();
    yy += d.y() * d.y();
  }
  const double spread = std::hypot(xx - yy, 2.0 * xy), total = xx + yy;
  if (std::sqrt((total - spread) / std::max(total + spread, 1e-12)) > kStraight) return Eigen::Vector2d::Zero();
  const double direction = 0.5 * std::atan2(2.0 * xy, xx - yy);
  const Eigen::Vector2d normal(-std::sin(direction), std::cos(direction));
  return normal.dot(points.front()) > 0.0 ? Eigen::Vector2d(-normal) : normal;
}

}  // namespace

Sighting sightOf(const PlacedScan& placed, const Eigen::Vector2d& p_odom, double margin) {
  const Eigen::Vector2d p = placed.T_odom_scan.inverse() * p_odom;
  const double range = p.norm();
  if (range > placed.scan.range_max || range < 0.05) return Sighting::kNothing;
  const int bin = PolarScan::binOf(std::atan2(p.y(), p.x()));
  const double slack = kSameRange + kRangeShare * range;
  bool seen_through = true;
  for (int other = bin - 1; other <= bin + 1; ++other) {
    const int wrapped = PolarScan::wrapBin(other);
    if (placed.scan.isUnknown(wrapped)) {
      seen_through = false;
      continue;
    }
    const double seen = placed.scan.rangeAt(wrapped);
    if (placed.scan.isHit(wrapped) && std::abs(seen - range) < slack) return Sighting::kMatch;
    if (seen < range + kSeenThrough + margin + kRangeShare * range) seen_through = false;
  }
  return seen_through ? Sighting::kSeenThrough : Sighting::kNothing;
}

Submap::Submap(std::vector<PlacedScan> scans) : scans_(std::move(scans)) {
  for (std::size_t i = 0; i < scans_.size(); ++i) {
    const PlacedScan& placed = scans_[i];
    const double c = std::cos(placed.T_odom_scan.yaw), s = std::sin(placed.T_odom_scan.yaw);
    for (int bin = 0; bin < kPolarBins; ++bin) {
      if (!placed.scan.isHit(bin)) continue;
      const Eigen::Vector2d position = placed.T_odom_scan * pointOf(placed.scan, bin);
      if (isContradicted(position, i)) continue;
      const Eigen::Vector2d n = normalAt(placed.scan, bin);
      points_.push_back({position, {c * n.x() - s * n.y(), s * n.x() + c * n.y()}});
    }
  }
}

bool Submap::isContradicted(const Eigen::Vector2d& point, std::size_t own_scan) const {
  bool seen_through = false;
  for (std::size_t i = 0; i < scans_.size(); ++i) {
    if (i == own_scan) continue;
    const Sighting sight = sightOf(scans_[i], point);
    if (sight == Sighting::kMatch) return false;
    seen_through = seen_through || sight == Sighting::kSeenThrough;
  }
  return seen_through;
}

std::vector<SurfacePoint> Submap::sample(std::size_t count) const {
  std::vector<SurfacePoint> lined;
  for (const SurfacePoint& point : points_) {
    if (!point.normal.isZero()) lined.push_back(point);
  }
  if (lined.size() <= count) return lined;
  std::vector<SurfacePoint> chosen;
  for (std::size_t i = 0; i < count; ++i) chosen.push_back(lined[i * lined.size() / count]);
  return chosen;
}

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#include "submap.h"

#include <algorithm>
#include <array>
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

using ScanPoints = std::array<Eigen::Vector2d, kPolarBins>;

/// Where the hits of a scan are, in its frame; what is no hit is anything.
ScanPoints pointsOf(const PolarScan& scan) {
  static const ScanPoints kDirections = [] {
    ScanPoints directions;
    for (int bin = 0; bin < kPolarBins; ++bin) {
      const double bearing = PolarScan::bearingOf(bin);
      directions[static_cast<std::size_t>(bin)] = {std::cos(bearing), std::sin(bearing)};
    }
    return directions;
  }();
  ScanPoints points;
  for (int bin = 0; bin < kPolarBins; ++bin) {
    points[static_cast<std::size_t>(bin)] = scan.rangeAt(bin) * kDirections[static_cast<std::size_t>(bin)];
  }
  return points;
}

/// Principal direction of the bins about this one on the same surface; zero where they are no line.
Eigen::Vector2d normalAt(const PolarScan& scan, const ScanPoints& all, int bin) {
  std::array<Eigen::Vector2d, 2 * kNormalReach + 1> points;
  std::size_t count = 0;
  const auto take = [&](int taken) { points[count++] = all[static_cast<std::size_t>(taken)]; };
  take(bin);
  for (const int side : {-1, 1}) {
    double range = scan.rangeAt(bin);
    for (int step = 1; step <= kNormalReach; ++step) {
      const int other = PolarScan::wrapBin(bin + side * step);
      if (!scan.isHit(other) || std::abs(scan.rangeAt(other) - range) > kSurfaceJump) break;
      range = scan.rangeAt(other);
      take(other);
    }
  }
  if (count < 4) return Eigen::Vector2d::Zero();
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < count; ++i) mean += points[i] / static_cast<double>(count);
  double xx = 0.0, xy = 0.0, yy = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector2d d = points[i] - mean;
    xx += d.x() * d.x();
    xy += d.x() * d.y();
    yy += d.y() * d.y();
  }
  const double spread = std::hypot(xx - yy, 2.0 * xy), total = xx + yy;
  if (std::sqrt((total - spread) / std::max(total + spread, 1e-12)) > kStraight) return Eigen::Vector2d::Zero();
  const double direction = 0.5 * std::atan2(2.0 * xy, xx - yy);
  const Eigen::Vector2d normal(-std::sin(direction), std::cos(direction));
  return normal.dot(points[0]) > 0.0 ? Eigen::Vector2d(-normal) : normal;
}

}  // namespace

Sighting sightOf(const PolarScan& scan, const Eigen::Vector2d& p, double margin) {
  const double range = p.norm();
  if (range > scan.range_max || range < 0.05) return Sighting::kNothing;
  const int bin = PolarScan::binOf(std::atan2(p.y(), p.x()));
  const double slack = kSameRange + kRangeShare * range;
  bool seen_through = true;
  for (int other = bin - 1; other <= bin + 1; ++other) {
    const int wrapped = PolarScan::wrapBin(other);
    if (scan.isUnknown(wrapped)) {
      seen_through = false;
      continue;
    }
    const double seen = scan.rangeAt(wrapped);
    if (scan.isHit(wrapped) && std::abs(seen - range) < slack) return Sighting::kMatch;
    if (seen < range + kSeenThrough + margin + kRangeShare * range) seen_through = false;
  }
  return seen_through ? Sighting::kSeenThrough : Sighting::kNothing;
}

Submap::Submap(std::vector<PlacedScan> scans) : scans_(std::move(scans)) {
  for (const PlacedScan& placed : scans_) into_scans_.emplace_back(placed.T_odom_scan);
  for (std::size_t i = 0; i < scans_.size(); ++i) {
    const PlacedScan& placed = scans_[i];
    const ScanPoints points = pointsOf(placed.scan);
    const Eigen::Matrix2d rotation = Eigen::Rotation2Dd(placed.T_odom_scan.yaw).toRotationMatrix();
    for (int bin = 0; bin < kPolarBins; ++bin) {
      if (!placed.scan.isHit(bin)) continue;
      const Eigen::Vector2d position = placed.T_odom_scan.position() + rotation * points[static_cast<std::size_t>(bin)];
      if (isContradicted(position, i)) continue;
      points_.push_back({position, rotation * normalAt(placed.scan, points, bin)});
    }
  }
}

bool Submap::isContradicted(const Eigen::Vector2d& point, std::size_t own_scan) const {
  bool seen_through = false;
  for (std::size_t i = 0; i < scans_.size(); ++i) {
    if (i == own_scan) continue;
    const Sighting said = sight(i, point);
    if (said == Sighting::kMatch) return false;
    seen_through = seen_through || said == Sighting::kSeenThrough;
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

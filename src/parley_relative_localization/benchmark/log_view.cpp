// SPDX-License-Identifier: BSD-3-Clause
#include "log_view.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace parley::study {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr double kFar = 15.0;        // [m] as far as a beam is followed
constexpr double kNoReturn = 80.0;   // [m] the log's own sign
constexpr double kApex = 1e-3;       // [m] behind the lidar, so that its own place is inside what it saw
constexpr double kLeast = 0.02;      // [m] nearer readings are none
constexpr double kJoin = 0.15;       // [m] neighbouring returns are of one surface within this
constexpr double kJoinShare = 0.06;  // [-] and this share of their range

/// The outline of what a scan saw: from just behind the lidar around the ends of its beams and back.
struct Corner {
  Eigen::Vector2d p;   // [m] map
  double range = 0.0;  // [m] from the scan's own place
  bool is_hit = false;
};

std::vector<Corner> outlineOf(const LogScan& scan) {
  std::vector<Corner> corners{{scan.T_map_base * Eigen::Vector2d(-kApex, 0.0), 0.0, false}};
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    const double range = static_cast<double>(scan.ranges[i]);
    const bool is_known = range >= kLeast;  // not for NaN
    const bool is_hit = is_known && range < std::min(kFar, kNoReturn);
    const double length = is_hit ? range : is_known ? kFar : 0.0;
    const double bearing = scan.angle_min + static_cast<double>(i) * scan.angle_increment;
    corners.push_back(
        {scan.T_map_base * Eigen::Vector2d(length * std::cos(bearing), length * std::sin(bearing)), length, is_hit});
  }
  return corners;
}

/// Along one bin: the nearest side of the outline, and how many there are.
struct Crossing {
  double range = std::numeric_limits<double>::infinity();  // [m]
  bool is_surface = false;
  int count = 0;  // [-] odd if the place is inside
};

class Outline {
 public:
  Outline(const LogScan& scan, const Pose2& T_map_base, std::size_t bins) : crossings_(bins) {
    const std::vector<Corner> corners = outlineOf(scan);
    const Pose2 T_base_map = T_map_base.inverse();
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Corner &a = corners[i], &b = corners[(i + 1) % corners.size()];
      const bool joined = std::abs(a.range - b.range) < kJoin + kJoinShare * std::min(a.range, b.range);
      addSide(T_base_map * a.p, T_base_map * b.p, a.is_hit && b.is_hit && joined);
    }
  }

  const Crossing& at(std::size_t bin) const { return crossings_[bin]; }

 private:
  /// In all bins whose middles the side covers.
  void addSide(const Eigen::Vector2d& a, const Eigen::Vector2d& b, bool is_surface) {
    const auto bins = static_cast<long>(crossings_.size());
    const double width = 2.0 * kPi / static_cast<double>(bins);
    const double from = std::atan2(a.y(), a.x()), to = from + angleBetween(from, std::atan2(b.y(), b.x()));
    const auto index = [&](double bearing) { return static_cast<long>(std::ceil((bearing + kPi) / width - 0.5)); };
    const Eigen::Vector2d along = b - a;
    for (long bin = index(std::min(from, to)); bin < index(std::max(from, to)); ++bin) {
      const double bearing = -kPi + (static_cast<double>(bin) + 0.5) * width;
      const Eigen::Vector2d ray(std::cos(bearing), std::sin(bearing));
      const double denominator = ray.x() * along.y() - ray.y() * along.x();
      if (denominator == 0.0) continue;
      const double range = (a.x() * along.y() - a.y() * along.x()) / denominator;
      Crossing& crossing = crossings_[static_cast<std::size_t>((bin % bins + bins) % bins)];
      ++crossing.count;
      if (range >= crossing.range) continue;
      crossing.range = range;
      crossing.is_surface = is_surface;
    }
  }

  std::vector<Crossing> crossings_;
};

}  // namespace

LogView viewFrom(const Pose2& T_map_base, const std::vector<const LogScan*>& scans, int bins, double reach) {
  LogView view;
  view.T_map_base = T_map_base;
  const auto count = static_cast<std::size_t>(bins);
  view.ranges.assign(count, kNan);
  view.seen_to.assign(count, 0.0F);
  for (const LogScan* scan : scans) {
    const Outline outline(*scan, T_map_base, count);
    for (std::size_t bin = 0; bin < count; ++bin) {
      const Crossing& crossing = outline.at(bin);
      if (crossing.count % 2 == 0 || !std::isnan(view.ranges[bin])) continue;
      view.seen_to[bin] = std::max(view.seen_to[bin], static_cast<float>(std::min(crossing.range, reach)));
      if (crossing.range > reach) {
        view.ranges[bin] = kInf;
      } else if (crossing.is_surface) {
        view.ranges[bin] = static_cast<float>(crossing.range);
      }
    }
  }
  return view;
}

ObstacleScan paintedScan(const LogView& view, const std::vector<test::Body>& bodies, double stamp, const test::LidarModel& lidar,
                         std::mt19937& random) {
  ObstacleScan scan;
  scan.stamp = stamp;
  scan.range_max = lidar.range;
  scan.ranges = view.ranges;
  scan.transient.assign(scan.ranges.size(), false);
  std::normal_distribution<double> noise(0.0, lidar.noise);
  for (const test::Body& body : bodies) {
    const Polygon outline = body.footprint.polygonAt(body.T_world_body);
    for (std::size_t bin = 0; bin < scan.ranges.size(); ++bin) {
      const double bearing = view.T_map_base.yaw + scan.bearingOf(bin);
      const double range = test::bodyRange(view.T_map_base.position(), {std::cos(bearing), std::sin(bearing)}, outline);
      const bool is_hidden = range > static_cast<double>(view.seen_to[bin]) || range >= static_cast<double>(scan.ranges[bin]);
      if (is_hidden || range > lidar.range) continue;
      scan.ranges[bin] = static_cast<float>(std::max(range + noise(random), kLeast));
      scan.transient[bin] = body.moving;
    }
  }
  test::findBlobs(scan);
  return scan;
}

}  // namespace parley::study

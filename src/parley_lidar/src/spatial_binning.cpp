// SPDX-License-Identifier: BSD-3-Clause
#include "spatial_binning.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "parley_geometry/angles.h"

namespace parley {
namespace {

/// What was seen in a bin besides obstacles.
struct Looks {
  bool own = false;     // the robot itself
  bool beyond = false;  // anything else
};

/// Of clouds with more points than allowed every n-th is used.
std::size_t strideOf(const LidarCloud& cloud, const LidarOptions& options) {
  const auto allowed = static_cast<std::size_t>(options.max_points);
  return std::max<std::size_t>(1, (cloud.points.size() + allowed - 1) / allowed);
}

bool isTimely(const LidarPoint& point, const LidarOptions& options) {
  return point.time >= 0.0F && point.time <= static_cast<float>(options.max_duration);
}

/// Finite, timely, neither in the lidar's blind zone nor farther than a lidar sees: 1 km, so that squares stay finite.
bool isValid(const LidarPoint& point, const LidarOptions& options) {
  const float squared = point.x * point.x + point.y * point.y + point.z * point.z;
  const auto nearest = static_cast<float>(options.min_range);
  return isTimely(point, options) && squared >= nearest * nearest && squared > 0.0F && squared < 1e6F;
}

/// Whether a point is on the robot itself: a mast, a cable, a wheel. Tilt does not matter to the lidar's own frame.
class OwnBody {
 public:
  OwnBody(const Footprint& footprint, double margin, const LidarMount& mount)
      : half_length_(static_cast<float>(0.5 * footprint.length + margin)),
        half_width_(static_cast<float>(0.5 * footprint.width + margin)),
        x_(static_cast<float>(mount.x)),
        y_(static_cast<float>(mount.y)),
        cos_(static_cast<float>(std::cos(mount.yaw))),
        sin_(static_cast<float>(std::sin(mount.yaw))) {}

  bool contains(const LidarPoint& p) const {
    return std::abs(x_ + cos_ * p.x - sin_ * p.y) <= half_length_ && std::abs(y_ + sin_ * p.x + cos_ * p.y) <= half_width_;
  }

 private:
  float half_length_, half_width_;  // [m]
  float x_, y_;                     // [m]
  float cos_, sin_;
};

BinnedScan withFreeBins(BinnedScan binned, const BearingBins& bins, const std::vector<Looks>& looks, double view, double yaw) {
  for (int bin = 0; bin < bins.count(); ++bin) {
    const Looks& look = looks[static_cast<std::size_t>(bin)];
    const double bearing = -kPi + (bin + 0.5) * bins.width();
    const bool in_view = std::abs(angleBetween(yaw, bearing)) <= 0.5 * view;
    if (look.beyond || (in_view && !look.own)) binned.addFree(bin);
  }
  return binned;
}

}  // namespace

double durationOf(const LidarCloud& cloud, const LidarOptions& options) {
  float latest = 0.0F;
  for (const LidarPoint& point : cloud.points) {
    if (isTimely(point, options)) latest = std::max(latest, point.time);
  }
  return static_cast<double>(latest);
}

BinnedScan binCloud(const LidarCloud& cloud, const ScanMotion& motion, const LidarOptions& options, const Footprint& footprint,
                    const LidarMount& mount) {
  const BearingBins bins(options.bins);
  const OwnBody own_body(footprint, options.self_margin, mount);
  BinnedScan binned(options.bins);
  binned.origin = motion.origin();
  binned.range_max = std::max(0.0, options.max_range - motion.travel());
  std::vector<Looks> looks(static_cast<std::size_t>(options.bins));
  const Eigen::Vector2f origin = binned.origin.cast<float>();
  const auto lowest = static_cast<float>(options.min_height), highest = static_cast<float>(options.max_height);
  const auto farthest = static_cast<float>(binned.range_max);
  const std::size_t stride = strideOf(cloud, options);
  binned.points.reserve(cloud.points.size() / stride + 1);
  for (std::size_t i = 0; i < cloud.points.size(); i += stride) {
    const LidarPoint& point = cloud.points[i];
    if (!isValid(point, options)) {
      ++binned.dropped;
      continue;
    }
    ++binned.valid;
    const Eigen::Vector3f p_base = motion.at(point.time) * Eigen::Vector3f(point.x, point.y, point.z);
    const Eigen::Vector2f ray = p_base.head<2>() - origin;
    const int bin = bins.of(static_cast<double>(std::atan2(ray.y(), ray.x())));
    Looks& look = looks[static_cast<std::size_t>(bin)];
    const bool own = own_body.contains(point);
    (own ? look.own : look.beyond) = true;
    const float range = ray.norm();
    if (own || p_base.z() < lowest || p_base.z() > highest || range > farthest) continue;
    binned.addHit(bin, range, bin);
    binned.points.push_back({p_base.head<2>(), range, bin});
  }
  return withFreeBins(std::move(binned), bins, looks, options.cloud_view, mount.yaw);
}

}  // namespace parley

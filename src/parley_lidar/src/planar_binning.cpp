// SPDX-License-Identifier: BSD-3-Clause
#include "planar_binning.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "parley_geometry/angles.h"

namespace parley {
namespace {

constexpr double kMaxAngle = 100.0;  // [rad] no driver counts more turns than that

/// How far a ray from inside the grown footprint stays in it, 0 if it starts outside. [m]
double rangeInside(const Footprint& footprint, double margin, const Eigen::Vector2d& from, const Eigen::Vector2d& direction) {
  if (!footprint.contains(from, margin)) return 0.0;
  const Eigen::Vector2d half(0.5 * footprint.length + margin, 0.5 * footprint.width + margin);
  double range = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 2; ++axis) {
    if (direction[axis] == 0.0) continue;
    range = std::min(range, (std::copysign(half[axis], direction[axis]) - from[axis]) / direction[axis]);
  }
  return range;
}

/// A beam as seen from where the scan ends.
struct MovedBeam {
  Eigen::Vector3f end = Eigen::Vector3f::Zero();  // [m]
  float range = 0.0F;                             // [m] level, from the lidar's last place
  double bearing = 0.0;                           // [rad]
};

MovedBeam movedBeam(const Eigen::Vector3f& p_lidar, const LidarToBase& T_base_lidar, const Eigen::Vector2d& origin) {
  const Eigen::Vector3f end = T_base_lidar * p_lidar;
  const Eigen::Vector2f ray = end.head<2>() - origin.cast<float>();
  return {end, ray.norm(), static_cast<double>(std::atan2(ray.y(), ray.x()))};
}

}  // namespace

double durationOf(const RangeScan& scan) {
  return scan.time_increment * static_cast<double>(std::max<std::size_t>(scan.ranges.size(), 1) - 1);
}

std::string planarProblem(const RangeScan& scan, const LidarOptions& options) {
  if (scan.ranges.empty()) return "the scan has no beams";
  if (scan.ranges.size() > static_cast<std::size_t>(options.max_beams)) return "the scan has more than max_beams beams";
  if (!(std::abs(scan.angle_min) <= kMaxAngle)) return "angle_min is not an angle";
  if (!(std::abs(scan.angle_increment) <= kPi) || scan.angle_increment == 0.0) return "angle_increment is not a step";
  if (!(std::abs(scan.angle_increment) * static_cast<double>(scan.ranges.size()) <= kMaxAngle)) {
    return "the scan goes round too often";
  }
  if (!(scan.range_max > 0.0)) return "range_max is not positive";
  if (!(scan.range_min >= 0.0 && scan.range_min < scan.range_max)) return "range_min is not within [0, range_max)";
  if (!(scan.time_increment >= 0.0)) return "time_increment is not positive or zero";
  if (!(durationOf(scan) <= options.max_duration)) return "the scan takes longer than max_duration";
  return {};
}

PlanarBinning::PlanarBinning(const LidarOptions& options, const Footprint& footprint, const LidarMount& mount)
    : options_(options), footprint_(footprint), mount_(mount), bins_(options.bins) {}

PlanarBinning::Beam PlanarBinning::beamAt(double angle) const {
  const double bearing = wrapAngle(angle + mount_.yaw);
  const Eigen::Vector2d direction(std::cos(bearing), std::sin(bearing));
  const Eigen::Vector3d direction_lidar(std::cos(angle), std::sin(angle), 0.0);
  const double self = rangeInside(footprint_, options_.self_margin, {mount_.x, mount_.y}, direction);
  return {direction_lidar.cast<float>(), direction.cast<float>(), static_cast<float>(self), bearing,
          binsOfBeam(bins_, bearing, std::abs(angle_increment_))};
}

void PlanarBinning::prepareBeams(const RangeScan& scan) {
  const bool same =
      beams_.size() == scan.ranges.size() && angle_min_ == scan.angle_min && angle_increment_ == scan.angle_increment;
  if (same) return;
  angle_min_ = scan.angle_min;
  angle_increment_ = scan.angle_increment;
  beams_.clear();
  beams_.reserve(scan.ranges.size());
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    beams_.push_back(beamAt(angle_min_ + static_cast<double>(i) * angle_increment_));
  }
}

/// By REP-117. Zero and below is what old drivers say for no reading. Many drivers and simulators give range_max itself
/// where nothing was met.
PlanarBinning::Reading PlanarBinning::read(const RangeScan& scan, std::size_t index) const {
  const float range = scan.ranges[index];
  const auto nearest = static_cast<float>(scan.range_min), farthest = static_cast<float>(scan.range_max);
  const auto limit = static_cast<float>(options_.max_range);
  const bool too_near = std::isinf(range) && range < 0.0F;
  if (std::isnan(range) || (range <= 0.0F && !too_near)) return {};
  if (range >= farthest || range > limit) return {true, false, false, std::min(farthest, limit)};
  const float used = std::max(range, nearest);
  return {true, used <= beams_[index].self_range, true, used};
}

BinnedScan PlanarBinning::bin(const RangeScan& scan, const ScanMotion& motion) {
  prepareBeams(scan);
  BinnedScan binned(bins_.count());
  binned.origin = motion.origin();
  // What a ray saw from where it started reaches less far from where the scan ends.
  binned.range_max = std::max(0.0, std::min(scan.range_max, options_.max_range) - motion.travel());
  binned.beam_width = std::max(1, static_cast<int>(std::ceil(std::abs(angle_increment_) / bins_.width() - 1e-6)));
  binned.points.reserve(scan.ranges.size());
  std::vector<Reading> readings;
  readings.reserve(scan.ranges.size());
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) readings.push_back(read(scan, i));
  for (const Reading& reading : readings) {
    binned.valid += reading.valid ? 1 : 0;
    binned.dropped += reading.valid ? 0 : 1;
  }
  if (motion.isStill()) return withStillBeams(std::move(binned), readings);
  return withMovingBeams(std::move(binned), readings, motion, scan.time_increment);
}

BinnedScan PlanarBinning::withStillBeams(BinnedScan binned, const std::vector<Reading>& readings) const {
  const Eigen::Vector2f origin = binned.origin.cast<float>();
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const Reading& reading = readings[i];
    const Beam& beam = beams_[i];
    if (!reading.valid || reading.own) continue;
    for (int k = 0; k < beam.span.count; ++k) {
      const int bin = bins_.wrap(beam.span.first + k);
      if (reading.hit) {
        binned.addHit(bin, reading.range, static_cast<int>(i));
      } else {
        binned.addFree(bin);
      }
    }
    if (reading.hit) {
      binned.points.push_back({origin + reading.range * beam.direction_base, reading.range, bins_.of(beam.bearing)});
    }
  }
  return binned;
}

BinnedScan PlanarBinning::withMovingBeams(BinnedScan binned, const std::vector<Reading>& readings, const ScanMotion& motion,
                                          double time_increment) const {
  const double step = std::abs(angle_increment_);
  std::vector<MovedBeam> moved;
  moved.reserve(readings.size());
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const auto time = static_cast<float>(static_cast<double>(i) * time_increment);
    moved.push_back(movedBeam(readings[i].range * beams_[i].direction_lidar, motion.at(time), binned.origin));
  }
  // Motion spreads beams unevenly: each reaches half way to its neighbours, else stripes between them look unseen.
  const auto spacing = [&](std::size_t i, std::size_t j) {
    if (j >= readings.size() || !readings[j].valid) return step;
    return std::min(2.0 * step, std::abs(angleBetween(moved[i].bearing, moved[j].bearing)));
  };
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const Reading& reading = readings[i];
    // Nothing is known beyond floor or ceiling.
    if (!reading.valid || reading.own || !isInBand(moved[i].end.z())) continue;
    const bool hit = reading.hit && moved[i].range <= binned.range_max;
    const BinSpan span = binsOfBeam(bins_, moved[i].bearing, std::max({step, spacing(i, i - 1), spacing(i, i + 1)}));
    for (int k = 0; k < span.count; ++k) {
      const int bin = bins_.wrap(span.first + k);
      if (hit) {
        binned.addHit(bin, moved[i].range, static_cast<int>(i));
      } else {
        binned.addFree(bin);
      }
    }
    if (hit) binned.points.push_back({moved[i].end.head<2>(), moved[i].range, bins_.of(moved[i].bearing)});
  }
  return binned;
}

/// A planar lidar's plane is its band, however low or high it is mounted: only tilt takes beams out of it.
bool PlanarBinning::isInBand(float height) const {
  return height >= std::min(options_.min_height, 0.5 * mount_.z) && height <= std::max(options_.max_height, 1.5 * mount_.z);
}

}  // namespace parley

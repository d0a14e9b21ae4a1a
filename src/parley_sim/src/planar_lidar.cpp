// SPDX-License-Identifier: BSD-3-Clause
#include "parley_sim/planar_lidar.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace parley::sim {
namespace {

constexpr double kRangeMin = 0.05;  // [m]

}  // namespace

PlanarLidar::PlanarLidar(const LidarSpec& spec, RandomStream noise) : spec_(spec), noise_(std::move(noise)) {
  for (int beam = 0; beam < spec.beams; ++beam) {
    const double angle = -kPi + 2.0 * kPi * beam / spec.beams;
    beams_.emplace_back(std::cos(angle), std::sin(angle));
  }
}

Eigen::Vector2d PlanarLidar::directionOf(int beam, const Eigen::Vector2d& heading) const {
  const Eigen::Vector2d& local = beams_[static_cast<std::size_t>(beam)];
  return {heading.x() * local.x() - heading.y() * local.y(), heading.y() * local.x() + heading.x() * local.y()};
}

template <class Shape>
void PlanarLidar::see(const Standing<Shape>& standing, const Pose2& T_world_lidar, std::vector<double>& ranges) const {
  const Eigen::Vector2d offset = standing.shape.center - T_world_lidar.position();
  const double gap = offset.norm(), radius = circumradius(standing.shape);
  if (gap > spec_.range + radius) return;
  // only the beams that point at it
  const double half_angle = gap > radius ? std::asin(radius / gap) : kPi;
  const double bearing = std::atan2(offset.y(), offset.x()) - T_world_lidar.yaw;
  const double increment = 2.0 * kPi / spec_.beams;
  const int first = static_cast<int>(std::floor((bearing - half_angle + kPi) / increment));
  const int count = std::min(spec_.beams, static_cast<int>(std::ceil(2.0 * half_angle / increment)) + 2);
  for (int i = first; i < first + count; ++i) {
    const int beam = ((i % spec_.beams) + spec_.beams) % spec_.beams;
    const Eigen::Vector2d direction = directionOf(beam, T_world_lidar.direction());
    const std::optional<Crossing> hit = crossing(standing.shape, T_world_lidar.position(), direction);
    if (!hit || hit->leave < 0.0) continue;
    double& range = ranges[static_cast<std::size_t>(beam)];
    range = std::min(range, std::max(hit->enter, 0.0));
  }
}

RangeScan PlanarLidar::scan(double stamp, const Pose2& T_world_base, const Scene& scene, int self) {
  const Pose2 T_world_lidar = T_world_base * spec_.pose;
  const Eigen::Vector2d heading = T_world_lidar.direction();
  std::vector<double> ranges;
  ranges.reserve(beams_.size());
  for (int beam = 0; beam < spec_.beams; ++beam) {
    ranges.push_back(scene.world->castRay(T_world_lidar.position(), directionOf(beam, heading), spec_.range));
  }
  for (const Standing<Box>& box : scene.boxes) {
    if (box.robot != self) see(box, T_world_lidar, ranges);
  }
  for (const Standing<Disc>& disc : scene.discs) see(disc, T_world_lidar, ranges);

  RangeScan scan;
  scan.stamp = stamp;
  scan.angle_min = -kPi;
  scan.angle_increment = 2.0 * kPi / spec_.beams;
  scan.range_min = kRangeMin;
  scan.range_max = spec_.range;
  scan.ranges.reserve(ranges.size());
  for (const double range : ranges) {
    // one draw a beam, hit or not: what others do must not shift this robot's noise
    const double noisy = range + spec_.noise * noise_.normal();
    const bool seen = range <= spec_.range;
    scan.ranges.push_back(!seen               ? std::numeric_limits<float>::infinity()
                          : noisy < kRangeMin ? -std::numeric_limits<float>::infinity()
                                              : static_cast<float>(std::min(noisy, spec_.range)));
  }
  return scan;
}

}  // namespace parley::sim

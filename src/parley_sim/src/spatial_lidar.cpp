// SPDX-License-Identifier: BSD-3-Clause
#include "parley_sim/spatial_lidar.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace parley::sim {
namespace {

constexpr double kPointsPerSecond = 200000.0;
constexpr double kLowest = -7.0 * kPi / 180.0;   // [rad]
constexpr double kHighest = 52.0 * kPi / 180.0;  // [rad]
constexpr double kRangeMin = 0.1;                // [m]
constexpr int kElevations = 4096;                // [-] 0.014 degrees apart
constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Steps of a two-dimensional sequence of low discrepancy: powers of the inverse of the plastic number
constexpr double kAzimuthStep = 0.7548776662466927;
constexpr double kElevationStep = 0.5698402909980532;

/// Attitude and place of the lidar in the world: T_world_lidar.
Eigen::Isometry3d lidarPose(const Pose2& T_world_base, const Attitude::Angles& attitude, const LidarSpec& spec) {
  Eigen::Isometry3d T_world_base3 = Eigen::Isometry3d::Identity();
  T_world_base3.translation() << T_world_base.x, T_world_base.y, 0.0;
  T_world_base3.linear() =
      (Eigen::AngleAxisd(T_world_base.yaw, Eigen::Vector3d::UnitZ()) *
       Eigen::AngleAxisd(attitude.pitch, Eigen::Vector3d::UnitY()) * Eigen::AngleAxisd(attitude.roll, Eigen::Vector3d::UnitX()))
          .toRotationMatrix();
  Eigen::Isometry3d T_base_lidar = Eigen::Isometry3d::Identity();
  T_base_lidar.translation() << spec.pose.x, spec.pose.y, spec.height;
  T_base_lidar.linear() = Eigen::AngleAxisd(spec.pose.yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return T_world_base3 * T_base_lidar;
}

/// Where a ray meets an upright body of some height; distances over the floor. [m] +inf if it does not.
double meeting(const Crossing& inside, double height, double start_height, double slope) {
  const double enter = std::max(inside.enter, 0.0);
  if (inside.leave < enter) return kInfinity;
  const double at_side = start_height + slope * enter;
  if (at_side <= height) return at_side >= 0.0 ? enter : kInfinity;
  // above the side where it enters: it may come down on the top
  const double at_top = slope < 0.0 ? (height - start_height) / slope : kInfinity;
  return at_top <= inside.leave ? at_top : kInfinity;
}

}  // namespace

SpatialLidar::SpatialLidar(const LidarSpec& spec, RandomStream noise) : spec_(spec), noise_(std::move(noise)) {
  const double azimuth = 2.0 * kPi * noise_.uniform();
  heading_ = {std::cos(azimuth), std::sin(azimuth)};
  elevation_ = noise_.uniform();
  for (int i = 0; i < kElevations; ++i) {
    const double angle = kLowest + (kHighest - kLowest) * (i + 0.5) / kElevations;
    elevations_.emplace_back(std::cos(angle), std::sin(angle));
  }
}

Eigen::Vector3d SpatialLidar::nextDirection() {
  // the azimuth goes on by a fixed turn, which is a complex product: no cosine a point
  static const Eigen::Vector2d kTurn(std::cos(2.0 * kPi * kAzimuthStep), std::sin(2.0 * kPi * kAzimuthStep));
  heading_ = {heading_.x() * kTurn.x() - heading_.y() * kTurn.y(), heading_.x() * kTurn.y() + heading_.y() * kTurn.x()};
  elevation_ += kElevationStep;
  elevation_ -= std::floor(elevation_);
  const Eigen::Vector2d& elevation = elevations_[static_cast<std::size_t>(elevation_ * kElevations)];
  return {elevation.x() * heading_.x(), elevation.x() * heading_.y(), elevation.y()};
}

std::vector<const Standing<Box>*> SpatialLidar::boxesNear(const Motion& motion, const Scene& scene, int self) const {
  std::vector<const Standing<Box>*> near;
  for (const Standing<Box>& box : scene.boxes) {
    const double reach = spec_.range + box.shape.circumradius() + spec_.pose.position().norm();
    if (box.robot != self && (box.shape.center - motion.to.position()).norm() < reach) near.push_back(&box);
  }
  return near;
}

double SpatialLidar::rangeOf(const Ray& ray, const Scene& scene, const std::vector<const Standing<Box>*>& boxes) const {
  const Eigen::Vector2d origin = ray.origin.head<2>();
  const double slope = ray.direction.z() / ray.flat, height = ray.origin.z();
  double nearest = slope < 0.0 ? -height / slope : kInfinity;  // the floor
  nearest = std::min(nearest, spec_.range * ray.flat);
  const bool floor_seen = slope < 0.0 && nearest == -height / slope;
  double found = floor_seen ? nearest : kInfinity;
  for (const Standing<Box>* box : boxes) {
    if (const auto inside = crossing(box->shape, origin, ray.flat_direction)) {
      const double range = meeting(*inside, box->height, height, slope);
      if (range <= nearest) nearest = found = range;
    }
  }
  for (const Standing<Disc>& disc : scene.discs) {
    if (const auto inside = crossing(disc.shape, origin, ray.flat_direction)) {
      const double range = meeting(*inside, disc.height, height, slope);
      if (range <= nearest) nearest = found = range;
    }
  }
  const double wall = scene.world->castRay(origin, ray.flat_direction, nearest);
  if (wall <= nearest) found = height + slope * wall <= kWallHeight ? wall : kInfinity;
  return found / ray.flat;
}

void SpatialLidar::sweep(const Motion& motion, const Scene& scene, int self) {
  if (!turning_) {
    turn_start_ = motion.start;
    turning_ = true;
  }
  heading_.normalize();  // rounding adds up over the points of a step
  owed_ += kPointsPerSecond * motion.duration;
  const int count = static_cast<int>(owed_);
  owed_ -= count;
  const std::vector<const Standing<Box>*> boxes = boxesNear(motion, scene, self);
  constexpr int kGroup = 50;  // points that share a pose: 0.25 ms, half a millimetre at 2 m/s
  Eigen::Isometry3d T_world_lidar = Eigen::Isometry3d::Identity();
  for (int i = 0; i < count; ++i) {
    const double fraction = (i + 0.5) / count;
    if (i % kGroup == 0) T_world_lidar = lidarPose(interpolate(motion.from, motion.to, fraction), motion.attitude, spec_);
    const Eigen::Vector3d local = nextDirection();
    Ray ray{T_world_lidar.translation(), T_world_lidar.linear() * local, {}, 0.0};
    ray.flat = ray.direction.head<2>().norm();
    ray.flat_direction = ray.direction.head<2>() / ray.flat;
    const double range = rangeOf(ray, scene, boxes);
    const double noisy = range + spec_.noise * noise_.normal();
    if (range > spec_.range || noisy < kRangeMin) continue;
    const Eigen::Vector3f point = (noisy * local).cast<float>();
    const double time = motion.start + fraction * motion.duration - turn_start_;
    cloud_.points.push_back({point.x(), point.y(), point.z(), static_cast<float>(time)});
  }
}

LidarCloud SpatialLidar::finish(double stamp) {
  LidarCloud turn = std::move(cloud_);
  turn.stamp = stamp;
  cloud_ = {};
  cloud_.points.reserve(turn.points.size());
  turning_ = false;
  return turn;
}

}  // namespace parley::sim

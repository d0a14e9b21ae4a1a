// SPDX-License-Identifier: BSD-3-Clause
#include "scan_motion.h"

#include <Eigen/Geometry>
#include <cmath>

namespace parley {
namespace {

constexpr double kSlice = 0.001;  // [s]

/// The lidar at one time, seen from the levelled base frame at another.
LidarToBase lidarToBase(const Odometry& then, const Odometry& end, const LidarMount& mount) {
  const Pose2 T_end_then = end.pose.inverse() * then.pose;
  const auto about = [](double angle, const Eigen::Vector3d& axis) { return Eigen::AngleAxisd(angle, axis); };
  const Eigen::Matrix3d attitude = (about(T_end_then.yaw, Eigen::Vector3d::UnitZ()) *
                                    about(then.pitch, Eigen::Vector3d::UnitY()) * about(then.roll, Eigen::Vector3d::UnitX()))
                                       .toRotationMatrix();
  const Eigen::Vector3d place =
      attitude * Eigen::Vector3d(mount.x, mount.y, mount.z) + Eigen::Vector3d(T_end_then.x, T_end_then.y, 0.0);
  const Eigen::Matrix3d turn = attitude * about(mount.yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return {turn.cast<float>(), place.cast<float>()};
}

}  // namespace

std::optional<ScanMotion> ScanMotion::over(const OdometryBuffer& odometry, double start, double duration,
                                           const LidarMount& mount) {
  const std::optional<Odometry> first = odometry.at(start), last = odometry.at(start + duration);
  if (!first || !last) return std::nullopt;
  ScanMotion motion;
  motion.end_ = *last;
  motion.origin_ = lidarToBase(*last, *last, mount).translation.head<2>().cast<double>();
  motion.travel_ = (lidarToBase(*first, *last, mount).translation.head<2>().cast<double>() - motion.origin_).norm();
  const auto count = static_cast<std::size_t>(std::max(1.0, std::ceil(duration / kSlice)));
  const double step = duration / static_cast<double>(count);
  motion.slices_per_second_ = duration > 0.0 ? static_cast<float>(1.0 / step) : 0.0F;
  motion.slices_.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Odometry middle = odometry.at(start + (static_cast<double>(i) + 0.5) * step).value_or(*last);
    motion.slices_.push_back(lidarToBase(middle, *last, mount));
  }
  return motion;
}

}  // namespace parley

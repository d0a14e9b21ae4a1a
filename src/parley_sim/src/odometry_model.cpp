// SPDX-License-Identifier: BSD-3-Clause
#include "parley_sim/odometry_model.h"

#include <cmath>

namespace parley::sim {
namespace {

constexpr double kMetresPerRadian = 0.2;  // [m/rad] turning on the spot drifts as little as driving this far
constexpr double kSpeedNoise = 0.002;     // [m/s]
constexpr double kTurnRateNoise = 0.001;  // [rad/s]

}  // namespace

OdometryModel::OdometryModel(const OdometrySpec& spec, double attitude_noise, RandomStream stream)
    : spec_(spec), attitude_noise_(attitude_noise), stream_(std::move(stream)) {}

void OdometryModel::advance(const Pose2& from, const Pose2& to, const Twist2& twist, double dt) {
  const Pose2 moved = from.inverse() * to;
  const double distance = std::abs(twist.speed) * dt;
  const double travelled = distance + kMetresPerRadian * std::abs(moved.yaw);
  const double translation = spec_.translation_noise * std::sqrt(distance);
  const double rotation = spec_.rotation_noise * std::sqrt(travelled);
  // always three draws, so that the noise of an hour does not depend on where the robot stood
  const double x = stream_.normal(), y = stream_.normal(), yaw = stream_.normal();
  pose_ = pose_ * Pose2{moved.x + translation * x, moved.y + translation * y, moved.yaw + rotation * yaw};
}

Odometry OdometryModel::reading(double stamp, const Twist2& twist, const Attitude::Angles& attitude) {
  Odometry odometry;
  odometry.stamp = stamp;
  odometry.pose = pose_;
  odometry.twist.speed = twist.speed + kSpeedNoise * stream_.normal();
  odometry.twist.turn_rate = twist.turn_rate + kTurnRateNoise * stream_.normal();
  odometry.roll = attitude.roll + attitude_noise_ * stream_.normal();
  odometry.pitch = attitude.pitch + attitude_noise_ * stream_.normal();
  return odometry;
}

}  // namespace parley::sim

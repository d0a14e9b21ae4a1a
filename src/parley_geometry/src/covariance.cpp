// SPDX-License-Identifier: BSD-3-Clause
#include "parley_geometry/covariance.h"

#include <Eigen/Cholesky>

namespace parley {
namespace {

/// d(T_a_b * T_b_c) / d(T_a_b).
Eigen::Matrix3d compositionJacobianLeft(const Pose2& a, const Pose2& b) {
  const double c = std::cos(a.yaw), s = std::sin(a.yaw);
  Eigen::Matrix3d j = Eigen::Matrix3d::Identity();
  j(0, 2) = -s * b.x - c * b.y;
  j(1, 2) = c * b.x - s * b.y;
  return j;
}

Eigen::Matrix3d rotation(double yaw) {
  const double c = std::cos(yaw), s = std::sin(yaw);
  Eigen::Matrix3d r = Eigen::Matrix3d::Identity();
  r(0, 0) = c;
  r(0, 1) = -s;
  r(1, 0) = s;
  r(1, 1) = c;
  return r;
}

}  // namespace

PoseEstimate compose(const PoseEstimate& T_a_b, const PoseEstimate& T_b_c) {
  const Eigen::Matrix3d left = compositionJacobianLeft(T_a_b.pose, T_b_c.pose);
  const Eigen::Matrix3d right = rotation(T_a_b.pose.yaw);
  return {T_a_b.pose * T_b_c.pose, left * T_a_b.covariance * left.transpose() + right * T_b_c.covariance * right.transpose()};
}

PoseEstimate inverse(const PoseEstimate& T_a_b) {
  const Pose2& pose = T_a_b.pose;
  const Pose2 inverted = pose.inverse();
  Eigen::Matrix3d j = -rotation(-pose.yaw);
  j(2, 2) = -1.0;
  // Turning frame b about a's origin moves a's origin as seen from b.
  j(0, 2) = inverted.y;
  j(1, 2) = -inverted.x;
  return {inverted, j * T_a_b.covariance * j.transpose()};
}

Eigen::Matrix2d pointCovariance(const PoseEstimate& T_a_b, const Eigen::Vector2d& p_b) {
  const Eigen::Matrix3d j = compositionJacobianLeft(T_a_b.pose, {p_b.x(), p_b.y(), 0.0});
  return (j * T_a_b.covariance * j.transpose()).topLeftCorner<2, 2>();
}

bool isCovariance(const Covariance3& covariance) {
  if (!covariance.allFinite() || !covariance.isApprox(covariance.transpose(), 1e-6)) return false;
  return covariance.llt().info() == Eigen::Success;
}

}  // namespace parley

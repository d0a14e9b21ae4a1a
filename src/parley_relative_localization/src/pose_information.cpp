// SPDX-License-Identifier: BSD-3-Clause
#include "pose_information.h"

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace parley {
namespace {

/// d(position of the child's origin) / d(motion about center), yaw kept.
Eigen::Matrix3d leverOf(const Pose2& pose, const Eigen::Vector2d& center) {
  Eigen::Matrix3d lever = Eigen::Matrix3d::Identity();
  lever(0, 2) = -(pose.y - center.y());
  lever(1, 2) = pose.x - center.x();
  return lever;
}

}  // namespace

PoseInformation unobserved(const Pose2& pose, const Eigen::Vector2d& center) {
  PoseInformation result;
  result.pose = pose;
  result.center = center;
  return result;
}

Pose2 movedAbout(const Pose2& pose, const Eigen::Vector2d& center, const Eigen::Vector3d& step) {
  const Eigen::Vector2d turned = Pose2{0.0, 0.0, step.z()} * Eigen::Vector2d(pose.position() - center);
  const Eigen::Vector2d p = center + turned + step.head<2>();
  return {p.x(), p.y(), wrapAngle(pose.yaw + step.z())};
}

Eigen::Vector3d stepBetween(const Pose2& from, const Pose2& to, const Eigen::Vector2d& center) {
  const double turn = angleBetween(from.yaw, to.yaw);
  const Pose2 turned = movedAbout(from, center, {0.0, 0.0, turn});
  return {to.x - turned.x, to.y - turned.y, turn};
}

Covariance3 covarianceOfPose(const Pose2& pose, const Eigen::Vector2d& center, const Eigen::Matrix3d& about_center) {
  const Eigen::Matrix3d lever = leverOf(pose, center);
  return lever * about_center * lever.transpose();
}

Eigen::Matrix3d covarianceAbout(const PoseEstimate& estimate, const Eigen::Vector2d& center) {
  Eigen::Matrix3d back = leverOf(estimate.pose, center);
  back.topRightCorner<2, 1>() *= -1.0;
  return back * estimate.covariance * back.transpose();
}

Eigen::Matrix3d informationAbout(const PoseInformation& estimate, const Eigen::Vector2d& center) {
  Eigen::Matrix3d moved = Eigen::Matrix3d::Identity();
  moved(0, 2) = center.y() - estimate.center.y();
  moved(1, 2) = estimate.center.x() - center.x();
  return moved.transpose() * estimate.information * moved;
}

Observability observabilityOf(const Eigen::Matrix3d& information) {
  const Eigen::Matrix2d h_tt = information.topLeftCorner<2, 2>();
  const Eigen::Vector2d h_tr = information.topRightCorner<2, 1>();
  const double h_rr = information(2, 2), trace = h_tt.trace();
  if (!(h_rr > 0.0) || !(trace > 0.0)) return {};
  const Eigen::Matrix2d schur = h_tt - h_tr * h_tr.transpose() / h_rr;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(schur);
  return {std::max(solver.eigenvalues()(0), 0.0) / trace, solver.eigenvectors().col(0)};
}

Eigen::Matrix3d withoutDirection(const Eigen::Matrix3d& information, const Eigen::Vector2d& direction) {
  // Marginalising the direction: what remains is known whatever the translation along it.
  const Eigen::Vector3d u(direction.x(), direction.y(), 0.0);
  const Eigen::Vector3d column = information * u;
  const double along = u.dot(column);
  if (!(along > 0.0)) return information;
  return information - column * column.transpose() / along;
}

}  // namespace parley

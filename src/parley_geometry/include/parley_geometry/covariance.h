// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "parley_geometry/pose2.h"

namespace parley {

/// Covariance of (x, y, yaw) of a pose T_a_b, as an error in the axes of frame a. [m^2, m rad, rad^2]
using Covariance3 = Eigen::Matrix3d;

/// A relative pose with its uncertainty.
struct PoseEstimate {
  Pose2 pose;
  Covariance3 covariance = Covariance3::Zero();
};

/// Compounding of independent estimates: T_a_c from T_a_b and T_b_c, first order (Smith, Self, Cheeseman 1990).
PoseEstimate compose(const PoseEstimate& T_a_b, const PoseEstimate& T_b_c);

/// T_b_a from T_a_b, first order.
PoseEstimate inverse(const PoseEstimate& T_a_b);

/// Covariance, in frame a, of the point p given exactly in frame b. [m^2]
Eigen::Matrix2d pointCovariance(const PoseEstimate& T_a_b, const Eigen::Vector2d& p_b);

/// Symmetric, finite and positive definite.
bool isCovariance(const Covariance3& covariance);

}  // namespace parley

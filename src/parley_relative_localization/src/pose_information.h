// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "parley_geometry/covariance.h"

namespace parley {

/// What a measurement says of a pose, as the information of a small motion (x, y, yaw) of the child frame about `center`,
/// a place in the parent frame. Directions it does not observe have no information.
struct PoseInformation {
  Pose2 pose;                                             // T_parent_child
  Eigen::Vector2d center = Eigen::Vector2d::Zero();       // [m] in the parent frame
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  // [1/m^2, 1/(m rad), 1/rad^2]
};

/// A pose of which nothing is known: a place to start from.
PoseInformation unobserved(const Pose2& pose, const Eigen::Vector2d& center);

/// Moves the child frame by (x, y, yaw) about `center`.
Pose2 movedAbout(const Pose2& pose, const Eigen::Vector2d& center, const Eigen::Vector3d& step);

/// The step that movedAbout needs to get from one pose to the other.
Eigen::Vector3d stepBetween(const Pose2& from, const Pose2& to, const Eigen::Vector2d& center);

/// Covariance of the pose's (x, y, yaw) from that of a motion about `center`.
Covariance3 covarianceOfPose(const Pose2& pose, const Eigen::Vector2d& center, const Eigen::Matrix3d& about_center);

/// And back: of a motion about `center`.
Eigen::Matrix3d covarianceAbout(const PoseEstimate& estimate, const Eigen::Vector2d& center);

/// The same information as of a motion about another place.
Eigen::Matrix3d informationAbout(const PoseInformation& estimate, const Eigen::Vector2d& center);

/// How well a translation is observed once the rotation has taken its part: Schur complement onto x and y.
struct Observability {
  double share = 0.0;                                  // [-] weakest direction's part of the information on translation
  Eigen::Vector2d weakest = Eigen::Vector2d::UnitX();  // [-]
};

Observability observabilityOf(const Eigen::Matrix3d& information);

/// Takes the information on a translation along `direction` out, keeping what is known of all else.
Eigen::Matrix3d withoutDirection(const Eigen::Matrix3d& information, const Eigen::Vector2d& direction);

}  // namespace parley

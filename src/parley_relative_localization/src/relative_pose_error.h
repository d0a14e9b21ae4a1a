// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "parley_geometry/pose2.h"

namespace parley {

/// Residual of a measured T_a_b between two poses (x, y, yaw) in one frame, weighted by the root of its information.
/// The yaw is wrapped here, so that the poses need no manifold.
class RelativePoseError {
 public:
  RelativePoseError(const Pose2& T_a_b, Eigen::Matrix3d root_information)
      : measured_(T_a_b), root_information_(std::move(root_information)) {}

  template <class T>
  bool operator()(const T* a, const T* b, T* residual) const {
    using std::cos;
    using std::floor;
    using std::sin;
    const T c = cos(a[2]), s = sin(a[2]), dx = b[0] - a[0], dy = b[1] - a[1];
    Eigen::Matrix<T, 3, 1> error;
    error[0] = c * dx + s * dy - T(measured_.x);
    error[1] = -s * dx + c * dy - T(measured_.y);
    const T turn = b[2] - a[2] - T(measured_.yaw);
    error[2] = turn - T(2.0 * kPi) * floor((turn + T(kPi)) / T(2.0 * kPi));
    Eigen::Map<Eigen::Matrix<T, 3, 1>> weighted(residual);
    weighted = root_information_.template cast<T>() * error;
    return true;
  }

 private:
  Pose2 measured_;
  Eigen::Matrix3d root_information_;
};

}  // namespace parley

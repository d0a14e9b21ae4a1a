// SPDX-License-Identifier: BSD-3-Clause
#include "scan_matcher.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace parley {
namespace {

constexpr double kWideGate = 0.35;    // [m]
constexpr double kNarrowGate = 0.15;  // [m]
constexpr double kNoise = 0.03;       // [m] of a point against its line, 8 bits and odometry in the submap included
constexpr double kDone = 1e-5;        // [m] [rad] a step smaller than this is the last
constexpr double kCorrelation = 8.0;  // [-] points that share one error: how much less they say than independent ones
constexpr int kFewest = 12;           // [-] fewer inliers are no match

struct Normal {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  double squares = 0.0;  // [m^2]
  int inliers = 0;       // [-]
};

Normal accumulate(const PointIndex& target, const std::vector<SurfacePoint>& source, const Pose2& T,
                  const Eigen::Vector2d& center, double gate) {
  Normal sum;
  const double c = std::cos(T.yaw), s = std::sin(T.yaw);
  for (const SurfacePoint& point : source) {
    const Eigen::Vector2d p(T.x + c * point.position.x() - s * point.position.y(),
                            T.y + s * point.position.x() + c * point.position.y());
    const Eigen::Vector2d n(c * point.normal.x() - s * point.normal.y(), s * point.normal.x() + c * point.normal.y());
    const SurfacePoint* match = target.nearest(p, n, gate);
    if (match == nullptr) continue;
    const double distance = match->normal.dot(p - match->position);
    const double ratio = distance / gate, taper = 1.0 - ratio * ratio;
    const double weight = taper * taper;
    const Eigen::Vector2d arm = p - center;
    const Eigen::Vector3d j(match->normal.x(), match->normal.y(), match->normal.y() * arm.x() - match->normal.x() * arm.y());
    sum.information += weight * j * j.transpose();
    sum.gradient += weight * distance * j;
    sum.squares += distance * distance;
    ++sum.inliers;
  }
  const double precision = 1.0 / (kNoise * kNoise);
  sum.information *= precision;
  sum.gradient *= precision;
  return sum;
}

}  // namespace

ScanMatch refineMatch(const PointIndex& target, const std::vector<SurfacePoint>& source, const PoseInformation& prior,
                      int iterations) {
  ScanMatch match;
  match.estimate = prior;
  Pose2& T = match.estimate.pose;
  Normal sum;
  for (int i = 0; i < iterations && !match.converged; ++i) {
    const double gate = std::max(kNarrowGate, kWideGate * std::pow(0.8, i));
    sum = accumulate(target, source, T, prior.center, gate);
    if (sum.inliers < kFewest) return match;
    const Eigen::Vector3d away = stepBetween(prior.pose, T, prior.center);
    Eigen::Matrix3d h = sum.information + prior.information;
    h.diagonal() += Eigen::Vector3d(1e-3, 1e-3, 1e-3);  // directions that nothing observes stay where they are
    const Eigen::Vector3d step = -h.ldlt().solve(sum.gradient + prior.information * away);
    if (!step.allFinite()) return match;
    T = movedAbout(T, prior.center, step);
    match.converged = gate <= kNarrowGate && step.cwiseAbs().maxCoeff() < kDone;
  }
  sum = accumulate(target, source, T, prior.center, kNarrowGate);
  match.inliers = sum.inliers;
  match.residual = sum.inliers > 0 ? std::sqrt(sum.squares / sum.inliers) : 0.0;
  match.converged = sum.inliers >= kFewest;
  match.observability = observabilityOf(sum.information);
  match.estimate.information = sum.information / kCorrelation;
  return match;
}

}  // namespace parley

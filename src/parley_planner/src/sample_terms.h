// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "motion_terms.h"
#include "obstacle_term.h"
#include "parley_geometry/footprint.h"
#include "path_bounds.h"
#include "peer_term.h"

namespace parley {

/// What the terms count, as weights of squares in equation 1 of the paper.
struct TermWeights {
  double time;       // [1/s^5] w_T beside an integral of squared jerk in m^2/s^5
  double limits;     // [-] of an excess in units of the limit, per sample
  double margin;     // [1/m^2] of a margin or a distance to a teammate that is lacking, per sample
  double push;       // [1/m^2] of what is lacking of the distance that paths keep, per sample
  double deviation;  // [1/m^2] of the distance to the path that it begins with, per sample
};

/// What all samples of a curve are judged by.
struct SampleScene {
  const ReferencePath& reference;
  std::vector<double> speed_bounds;  // [m/s] at each of the reference's points
  std::vector<double> speed_slopes;  // [1/s] by which they grow per metre to the left
  std::vector<double> distances;     // [m] to what pushes paths away, to be kept at each of the reference's points
  const DistanceField& obstacles;
  const DistanceField& shape;  // what pushes paths away
  Margins margins;
  MotionLimits limits;
  Polygon corners;                     // [m] of the robot in base_link, counter-clockwise
  std::vector<Eigen::Vector2d> discs;  // [m] middles in base_link of the discs that cover it
  double disc_radius = 0.0;            // [m]
};

/// A moment of the curve, at a fixed share of its duration.
struct CurveSample {
  std::size_t piece = 0;
  double tau = 0.0;                                    // [-] in [0, 1] on the piece
  double near_s = 0.0;                                 // [m] about where on the reference it is
  Eigen::Vector2d heading = Eigen::Vector2d::UnitX();  // [-] of the drive that it starts from
  std::vector<PeerThere> peers;                        // those that are near then

  std::size_t residualCount(const SampleScene& scene) const { return 6 + scene.discs.size() + peers.size(); }
};

constexpr double kLeastBound = 0.2;   // [m/s] that a bound on the speed falls to beside the reference
constexpr double kSampleReach = 0.6;  // [m] along the reference within which a sample's nearest point is sought

/// The speed [m/s] that sight and the drive allow beside the reference.
template <class T>
T speedBound(const SampleScene& scene, const PathOffset<T>& offset) {
  const T slope = valueAlong(scene.reference, scene.speed_slopes, offset.along);
  const T bound = valueAlong(scene.reference, scene.speed_bounds, offset.along) + slope * offset.lateral;
  if (bound > T(scene.limits.speed)) return T(scene.limits.speed);
  return bound < T(kLeastBound) ? T(kLeastBound) : bound;
}

/// Square roots of the penalties S of equation 1 at one sample, `residualCount` of them.
template <class T>
void evaluateSample(const SampleScene& scene, const CurveSample& sample, const TermWeights& weights, const FlatSample<T>& x,
                    T* residuals) {
  const MotionLimits& limits = scene.limits;
  const double limit = std::sqrt(weights.limits), margin = std::sqrt(weights.margin);
  const PathOffset<T> offset = offsetFrom<T>(scene.reference, x.position, sample.near_s, kSampleReach);
  const Eigen::Matrix<T, 2, 1> heading = headingOf(x, sample.heading);
  *residuals++ = T(limit / limits.speed) * speedExcess<T>(x, speedBound(scene, offset));
  *residuals++ = T(limit / limits.turn_rate) * turnRateExcess(x, limits.turn_rate);
  *residuals++ = T(limit / limits.acceleration) * accelerationExcess(x, limits.acceleration);
  *residuals++ = T(limit / limits.turn_acceleration) * turnAccelerationExcess(x, limits.turn_acceleration);
  *residuals++ =
      T(std::sqrt(weights.push)) * pushLack(x, scene.shape, valueAlong(scene.reference, scene.distances, offset.along));
  *residuals++ = T(std::sqrt(weights.deviation)) * offset.lateral;
  for (const Eigen::Vector2d& disc : scene.discs) {
    const Eigen::Matrix<T, 2, 1> middle = carried<T>(disc, x.position, heading);
    *residuals++ = T(margin) * marginLack<T>(x, scene.obstacles, middle, scene.disc_radius, scene.margins);
  }
  for (const PeerThere& peer : sample.peers) *residuals++ = T(margin) * peerLack<T>(x, heading, scene.corners, peer);
}

}  // namespace parley

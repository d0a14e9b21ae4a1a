// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "flat_sample.h"
#include "smooth_polygon_distance.h"

namespace parley {

/// A teammate at the time of a sample.
struct PeerThere {
  Polygon footprint;  // [m] counter-clockwise
  double distance;    // [m] to be kept, the error of its pose included
};

constexpr double kPeerSharpness = 40.0;  // [1/m] the distance is believed less by at most 9 cm

/// What the robot's rectangle lacks of its distance to a teammate. [m] `corners`: of the robot in base_link, counter-clockwise.
template <class T>
T peerLack(const FlatSample<T>& x, const Eigen::Matrix<T, 2, 1>& heading, const Polygon& corners, const PeerThere& peer) {
  std::vector<Eigen::Matrix<T, 2, 1>> rectangle;
  rectangle.reserve(corners.size());
  for (const Eigen::Vector2d& corner : corners) rectangle.push_back(carried<T>(corner, x.position, heading));
  return excess<T>(T(peer.distance) - smoothPolygonDistance<T>(rectangle, peer.footprint, kPeerSharpness));
}

}  // namespace parley

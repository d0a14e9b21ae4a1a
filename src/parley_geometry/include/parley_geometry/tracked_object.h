// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace parley {

/// Something followed over several scans that is not of the map: a person, a teammate, a box on wheels.
struct TrackedObject {
  int id = 0;                                          // [-] stable while it is followed
  double stamp = 0.0;                                  // [s] of the last scan that saw it
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // [m] its middle, odom frame
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  // [m/s] odom frame
  double radius = 0.0;                                 // [m] of a disc that covers what was seen of it
  int observations = 0;                                // [-] scans that saw it
  bool moving = false;                                 // it moves, or did a moment ago
  bool has_moved = false;                              // it has been seen to move at some time: it may drive off again
};

}  // namespace parley

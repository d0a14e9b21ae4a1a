// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "parley_sim/scenario.h"
#include "parley_sim/shapes.h"

namespace parley::sim {

/// A disc that goes along its path and back for ever. Where it is depends on the time alone.
class MovingObstacle {
 public:
  explicit MovingObstacle(const MovingObstacleSpec& spec);

  Disc at(double time) const;

 private:
  MovingObstacleSpec spec_;
  double length_ = 0.0;  // [m] of the path, one way
};

}  // namespace parley::sim

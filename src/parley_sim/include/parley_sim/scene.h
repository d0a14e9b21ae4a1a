// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "parley_sim/shapes.h"
#include "parley_sim/world.h"

namespace parley::sim {

constexpr double kWallHeight = 2.5;    // [m] walls and doors
constexpr double kRobotHeight = 0.6;   // [m]
constexpr double kPersonHeight = 1.7;  // [m] moving obstacles

/// Something in the world that is not a wall, as lidars see it.
template <class Shape>
struct Standing {
  Shape shape;
  double height = 0.0;  // [m] from the floor
  int robot = -1;       // whose body it is, -1 if nobody's
};

/// All that lidars can see at one instant.
struct Scene {
  const World* world = nullptr;
  std::vector<Standing<Box>> boxes;   // robots and closed doors
  std::vector<Standing<Disc>> discs;  // moving obstacles
};

inline double circumradius(const Box& box) { return box.circumradius(); }
inline double circumradius(const Disc& disc) { return disc.radius; }

}  // namespace parley::sim

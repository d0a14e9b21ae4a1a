// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "parley_sim/drive_model.h"
#include "parley_sim/shapes.h"
#include "parley_sim/world.h"

namespace parley::sim {

/// One robot's body as the physics and the referee see it.
struct Body {
  bool present = false;  // false before it has joined
  BodyState state;
  double length = 0.0;  // [m]
  double width = 0.0;   // [m]

  Box box() const { return boxAt(state.pose, length, width); }
};

/// Everything in the world at one instant.
struct Snapshot {
  double time = 0.0;  // [s]
  std::vector<Body> bodies;
  std::vector<Box> doors;   // those that are closed
  std::vector<Disc> discs;  // moving obstacles
};

/// Walls and closed doors.
bool touchesSolid(const World& world, const std::vector<Box>& doors, const Box& box);

/// Anything that stops a body: walls, doors and other bodies.
bool isStopped(const World& world, const Snapshot& snapshot, std::size_t self, const Box& box);

/// Gap between a body and whatever it could collide with, at most `limit`. [m]
double clearance(const World& world, const Snapshot& snapshot, std::size_t self, double limit);

/// A body's motion over `dt`. Where it would get into something that stops it, it ends at the contact and stands.
BodyState drivenUntilContact(const World& world, const Snapshot& snapshot, std::size_t self, const Twist2& command,
                             const MotionLimits& limits, double dt);

}  // namespace parley::sim

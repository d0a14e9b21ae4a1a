// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <random>

#include "closed_loop.h"
#include "surroundings.h"

namespace parley::study {

/// What a problem is about. In each the robot has to come from where it stands into or through a gap.
enum class Place {
  kSlot,     // a slot leads off across a small chamber
  kDeadEnd,  // at the end of a dead end that it has to leave backwards
  kDoor,     // two small rooms, the door's wall at any slant
  kPocket    // a cluttered room with one slot out of it
};
constexpr int kPlaces = 4;
const char* nameOf(Place place);

struct NarrowProblem {
  Place place = Place::kSlot;
  bool meant_closed = false;  // the gap is plugged, or too narrow for the footprint
  World world;
  Pose2 start;
  Eigen::Vector2d target = Eigen::Vector2d::Zero();  // [m] to come within kTargetRadius of, with any heading
  Surroundings surroundings;                         // all of the world has been seen
};

/// A problem drawn from a seed: gaps of 0.5 to 0.8 m for a robot of 0.8 x 0.4 m, a fifth of them closed.
NarrowProblem narrowProblem(unsigned seed, double clearance);

/// Whether poses of `clearance` [m] connect start and target: a flood over 0.025 m and 96 headings that may also move
/// sideways. A drive that turns on the spot can follow any such way by going back and forth.
bool isOpen(const NarrowProblem& problem, const FootprintProbe& probe, double clearance);

}  // namespace parley::study

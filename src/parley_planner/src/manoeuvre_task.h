// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "drive_generator.h"
#include "sight_law.h"

namespace parley {

/// What is asked of a manoeuvre.
struct ManoeuvreTask {
  const Path& path;                    // to follow, from where the robot is
  const TrajectoryPoint& start;        // state it begins in
  const SampledTrajectory& committed;  // what is driven until then
  const DriveScene& scene;
  Margins margins;
  double push_distance;                     // [m] that obstacles push the path away
  const SightLaw* sight_law;                // null: does not matter
  const DistanceField& shape;               // what pushes the path away
  std::vector<Blocked::Body> bodies = {};   // that stand: a search for a way past them minds them
  const Surroundings* with_them = nullptr;  // null: there are none
};

}  // namespace parley

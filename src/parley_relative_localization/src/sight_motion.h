// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "meeting.h"

namespace parley {

/// A peer's way from its sightings: each says where its lidar was. Where that sits on the peer shows when a pose and a sighting
/// are of one instant; from then on each sighting is a pose, and a message that comes alone tells the way of its sightings.
class SightMotion {
 public:
  /// Adds the pose told, and those of all sightings, to the side's motion.
  void add(const MotionReport& report, MeetingSide& side);
  /// Likewise, for sightings that came since.
  void read(MeetingSide& side);

 private:
  MotionReport newest_;
  std::optional<Eigen::Vector2d> lidar_base_;  // [m]
};

}  // namespace parley

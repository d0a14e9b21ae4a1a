// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "parley_exchange/messages.h"

namespace parley {

/// Whether what a packet says can be true of a robot. `max_speed` [m/s] and `max_turn_rate` [rad/s] are those of the
/// fastest robot that is believed in.
struct Plausibility {
  double max_speed = 10.0;      // [m/s]
  double max_turn_rate = 10.0;  // [rad/s]

  bool holds(const Beacon& beacon) const;
  bool holds(const TrajectoryMessage& trajectory) const;
  bool holds(const IntentMessage& intent) const;
  bool holds(const Conflict& conflict) const;
  bool holds(const ObservationMessage& observations) const;
  /// The body as well. Kinds that are not known hold.
  bool holds(const Record& record) const;
  bool holds(const ContourBody& contour) const;
  bool holds(const AnchorBody& anchor) const;
  bool holds(const EdgeBody& edge) const;
};

/// Finite and where positions on the air can be.
bool isPlace(const Pose2& pose);
bool isPlace(const Eigen::Vector2d& position);

/// No two segments of the outline touch but neighbours at their common vertex, and no vertex repeats the one before.
bool isOutline(const std::vector<Eigen::Vector2i>& vertices, bool closed);

}  // namespace parley

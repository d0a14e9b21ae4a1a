// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "meeting.h"
#include "pose_information.h"

namespace parley {

/// A pose fitted to sightings of both sides, and what speaks for it.
struct SightFit {
  MeetingPose pose;
  Eigen::Vector2d center = Eigen::Vector2d::Zero();      // [m] place between the robots, own odom
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  // of a motion (x, y, yaw) about the center
  bool solved = false;
  int own_sights = 0;              // [-] own scans that saw the peer
  int peer_sights = 0;             // [-] scans of the peer that saw this robot
  int contradictions = 0;          // [-] scans that saw through the other
  int contradictions_in_row = 0;   // [-] newest own scans that did
  double residual = 0.0;           // [-] root mean square of the errors over their standard deviations
  double first = 0.0, last = 0.0;  // [s] of the agreeing sightings
  double travel = 0.0;             // [m] of each while the other saw it: what stands could be anything that stands
  double distinction = 0.0;        // [m] how far the motion is from two robots in a queue

  int score() const { return own_sights + 2 * peer_sights - 4 * contradictions; }
  bool isMutual(int own, int peer) const { return own_sights >= own && peer_sights >= peer; }
  double span() const { return last - first; }
};

/// Gauss-Newton with Cauchy weights over pose and time offset. The time offset has a prior about zero; `surfaces` is what
/// matched scans say of the pose.
SightFit fitSights(const MeetingSide& own, const MeetingSide& peer, const MeetingPose& start,
                   const std::optional<PoseInformation>& surfaces, const RelativeLocalizationOptions& options);

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "body_view.h"
#include "motion_history.h"
#include "parley_relative_localization/relative_localization_options.h"
#include "submap.h"

namespace parley {

constexpr double kBody = 0.45;  // [m] a robot's visible middle is at most this far from its centre

/// The blobs of one scan. `scan` has its free space too, if that is known.
struct SightRecord {
  double stamp = 0.0;  // [s] of the viewer's clock
  Pose2 T_odom_scan;
  std::vector<SightedBlob> blobs;
  PolarScan scan;
  bool has_scan = false;
  std::vector<std::string> owners;  // of each blob the known robot that was there then; empty: nobody known

  /// That blob is a known robot, but not this one.
  bool isOfAnother(std::size_t blob, const std::string& robot) const {
    return blob < owners.size() && !owners[blob].empty() && owners[blob] != robot;
  }
};

/// One robot's side of a meeting: how it moved and what it saw.
struct MeetingSide {
  std::string name;
  Footprint footprint;
  MotionHistory motion;
  std::deque<SightRecord> sights;

  void add(SightRecord record, std::size_t capacity);
  void forgetBefore(double stamp);
};

/// Where the peer would be, and how far its stamps are ahead of own ones.
struct MeetingPose {
  Pose2 T_odom_peerodom;
  double time_offset = 0.0;  // [s]
};

/// One sighting that agrees with a pose: predicted less observed place of the seen robot, in own odom.
struct SightTerm {
  bool own = true;                                     // own lidar saw the peer; else the peer's saw this robot
  double stamp = 0.0;                                  // [s] own clock
  double deviation = 0.0;                              // [m] standard deviation of the error
  double weight = 1.0;                                 // [-] less where the look is the same as the one before
  Eigen::Vector2d error = Eigen::Vector2d::Zero();     // [m]
  Eigen::Vector2d place = Eigen::Vector2d::Zero();     // [m] that moves with the peer's odom, own odom
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  // [m/s] of the error with the time offset
};

/// All sightings that agree with a pose, and how often one side looked through the other.
struct SightTerms {
  std::vector<SightTerm> terms;
  int contradictions = 0;         // [-]
  int contradictions_in_row = 0;  // [-] own scans from the newest one back, with nothing else in between
};

/// Looks in each side's sightings for the other robot where the pose says it should be, up to `gate` [m] off. What is known
/// to be a third robot is not the peer.
SightTerms agreeingSights(const MeetingSide& own, const MeetingSide& peer, const MeetingPose& pose, double gate,
                          const RelativeLocalizationOptions& options);

}  // namespace parley

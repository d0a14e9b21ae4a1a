// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/spaces/SE2StateSpace.h>

#include "parley_geometry/pose2.h"

namespace parley::study {

/// From pose to pose as a drive that turns on the spot does it: turn, straight on forwards or backwards, turn.
struct TurnDrive {
  double first_turn = 0.0;  // [rad]
  double length = 0.0;      // [m] negative backwards
  double last_turn = 0.0;   // [rad]

  double seconds() const;                                    // [s] from standing to standing, each of them
  double steps() const;                                      // [-] of the size that the lattice search checks
  Pose2 poseAt(const Pose2& from, double steps_done) const;  // on the way
};

/// The quicker one of driving forwards and backwards.
TurnDrive turnDriveBetween(const Pose2& from, const Pose2& to);

/// SE(2) for OMPL with these motions: distance is their time, interpolation goes along them, and they are checked every
/// 0.05 m and 3.75 degrees.
class TurnDriveSpace : public ompl::base::SE2StateSpace {
 public:
  static Pose2 poseOf(const ompl::base::State* state);
  static void setPose(ompl::base::State* state, const Pose2& pose);

  double distance(const ompl::base::State* from, const ompl::base::State* to) const override;
  void interpolate(const ompl::base::State* from, const ompl::base::State* to, double share,
                   ompl::base::State* result) const override;
  unsigned int validSegmentCount(const ompl::base::State* from, const ompl::base::State* to) const override;
};

}  // namespace parley::study

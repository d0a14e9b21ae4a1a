// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "parley_planner/planner.h"
#include "scenes.h"

namespace parley {

/// One robot at (3, 5) in a free room of 10 x 10 m with a goal at (8, 5).
class PlannerTest : public testing::Test {
 protected:
  PlannerTest() {
    route_.points = {{3.0, 5.0}, {8.0, 5.0}};
    route_.verdict = RouteVerdict::kThroughKnown;
    odometry_.pose = {3.0, 5.0, 0.0};
    std::mt19937 random(1);
    scan_ = castScan(World(10, 10, false), {3.0, 5.0, 0.0}, 0.0, 0.0, random);
  }
  PlanResult plan(double now) {
    odometry_.stamp = now;
    PlanRequest request{now, now + 0.05, odometry_, map_, scan_, odometry_.pose, tracks_, route_, goal_, 0.3, committed_};
    request.peers = peers_;
    return planner_.plan(request);
  }
  /// The robot is where a trajectory says, and moves so.
  void be(const TrajectoryPoint& state) {
    odometry_.pose = state.pose;
    odometry_.twist = state.twist;
  }
  Planner planner_{PlannerOptions(), robotFootprint(), robotLimits()};
  LocalMap map_ = seenMap(World(10, 10, false));
  ObstacleScan scan_;
  std::vector<TrackedObject> tracks_;
  std::vector<PeerMotion> peers_;
  Route route_;
  Odometry odometry_;
  Eigen::Vector2d goal_{8.0, 5.0};
  SampledTrajectory committed_;
};

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "closed_loop.h"
#include "scenes.h"

namespace parley {

struct TeamMember {
  Pose2 start;
  Eigen::Vector2d goal = Eigen::Vector2d::Zero();
  Footprint footprint = robotFootprint();
};

/// Robots with one planner each in one known world of 10 x 10 m and one frame. Each hears 0.1 s later what the others have
/// committed to and where they mean to go; their lidar sees the walls only.
class TeamLoop {
 public:
  TeamLoop(const World& world, const std::vector<TeamMember>& members);

  /// Until all have stood at their goals once, or for so long. [s]
  void run(double duration);

  bool allReached() const;
  double time() const { return now_; }
  int collisions() const { return collisions_; }  // footprints that overlap each other or a wall, counted at each 0.02 s
  int escapes() const;
  const TrajectoryPoint& state(std::size_t i) const { return robots_[i].state; }
  const PlanResult& plan(std::size_t i) const { return robots_[i].plan; }
  /// What is wrong with the trajectories that were committed; empty if nothing.
  const std::string& flaw() const { return flaw_; }

 private:
  struct Robot {
    TeamMember member;
    std::unique_ptr<Planner> planner;
    TrajectoryPoint state;
    SampledTrajectory committed;
    Route route;
    PlanResult plan;
    bool reached = false;
  };
  void step();
  std::vector<PeerMotion> others(std::size_t self, const std::vector<PeerMotion>& said) const;
  PeerMotion motionOf(std::size_t i) const;
  void think(std::size_t i, const std::vector<PeerMotion>& said);
  void judge();

  const World& world_;
  LocalMap map_;
  TrivialMap router_;
  std::vector<Robot> robots_;
  std::mt19937 random_{1};
  double now_ = 0.0;  // [s]
  int collisions_ = 0;
  std::string flaw_;
};

}  // namespace parley

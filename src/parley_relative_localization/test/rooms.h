// SPDX-License-Identifier: BSD-3-Clause
// Submaps and encounters in analytic rooms, with the truth at hand.
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "parley_relative_localization/relative_localization.h"
#include "simulated_lidar.h"
#include "surface_check.h"

namespace parley::test {

/// Scans from the given places, in an odom frame whose pose in the world is given.
inline std::vector<PlacedScan> scansFrom(const WallRange& walls, const std::vector<Pose2>& T_world_scans,
                                         const Pose2& T_world_odom, const LidarModel& lidar, std::mt19937& random,
                                         const std::vector<Body>& bodies = {}) {
  std::vector<PlacedScan> scans;
  for (const Pose2& T_world_scan : T_world_scans) {
    const ObstacleScan scan = simulatedScan(walls, bodies, T_world_scan, static_cast<double>(scans.size()), lidar, random);
    scans.push_back({static_cast<int>(scans.size()), scan.stamp, T_world_odom.inverse() * T_world_scan, polarScanOf(scan, true)});
  }
  return scans;
}

/// A straight corridor along x, 2 m wide, without any feature.
inline std::vector<WallSegment> corridor() { return {{{-50.0, 0.0}, {50.0, 0.0}}, {{50.0, 2.0}, {-50.0, 2.0}}}; }

/// A robot of an encounter: it moves as it is told, scans, and talks four times a second.
struct Actor {
  Actor(const std::string& robot_name, const Pose2& start, const Pose2& T_world_own_odom,
        const RelativeLocalizationOptions& options)
      : name(robot_name), T_world_base(start), T_world_odom(T_world_own_odom), localization(options, robot_name, kRobot) {}

  Pose2 odometry() const { return T_world_odom.inverse() * T_world_base; }
  Body body() const { return {kRobot, T_world_base, std::abs(twist.speed) > 0.1}; }
  MotionReport motion(double now) const { return {now + clock, odometry(), twist, kRobot, localization.travel()}; }

  std::string name;
  /// What its lidar stage sees.
  ObstacleScan scan(const WallRange& walls, const std::vector<Body>& bodies, double now, const LidarModel& lidar,
                    std::mt19937& random) const {
    const Pose2 T_world_lidar = T_world_base * Pose2{lidar_base.x(), lidar_base.y(), 0.0};
    ObstacleScan seen = simulatedScan(walls, bodies, T_world_lidar, now + clock, lidar, random);
    seen.origin = lidar_base;
    for (Blob& blob : seen.blobs) blob.position += lidar_base;
    return seen;
  }

  Pose2 T_world_base, T_world_odom;
  Eigen::Vector2d lidar_base = Eigen::Vector2d::Zero();  // [m] where its lidar sits
  Twist2 twist;
  double clock = 0.0;  // [s] ahead of the others'
  RelativeLocalization localization;
};

/// Robots in one world, stepped together at 10 Hz.
class Stage {
 public:
  explicit Stage(WallRange walls, unsigned seed = 1) : walls_(std::move(walls)), random_(seed) {}

  Actor& add(const std::string& name, const Pose2& start, const RelativeLocalizationOptions& options = {}) {
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    actors_.emplace_back(name, start, Pose2{5.0 * unit(random_), 5.0 * unit(random_), kPi * unit(random_)}, options);
    return actors_.back();
  }
  Actor& actor(std::size_t i) { return actors_[i]; }
  void reserve(std::size_t count) { actors_.reserve(count); }
  double now() const { return now_; }
  /// Pairs (from, to) that hear each other; all if empty.
  std::vector<std::pair<std::size_t, std::size_t>> links;

  void step(bool talk = true) {
    now_ += 0.1;
    for (Actor& actor : actors_)
      actor.T_world_base = integrateTwist(actor.T_world_base, actor.twist.speed, actor.twist.turn_rate, 0.1);
    for (Actor& actor : actors_) {
      std::vector<Body> bodies;
      for (const Actor& other : actors_) {
        if (&other != &actor) bodies.push_back(other.body());
      }
      actor.localization.addOwnScan(actor.odometry(), actor.scan(walls_, bodies, now_, lidar, random_));
    }
    if (talk && ++ticks_ % 2 == 0) {
      for (std::size_t i = 0; i < actors_.size(); ++i) {
        for (std::size_t j = 0; j < actors_.size(); ++j) tell(i, j);
      }
    }
    estimates.clear();
    for (Actor& actor : actors_) estimates.push_back(actor.localization.step(now_ + actor.clock));
  }

  /// What robot i holds of the robot of that name.
  PeerEstimate estimate(std::size_t i, const std::string& name) const {
    for (const PeerEstimate& estimate : estimates[i]) {
      if (estimate.peer == name) return estimate;
    }
    return {};
  }
  /// Error of robot i's estimate of where robot j stands now. [m], [rad]
  Pose2 errorOf(std::size_t i, std::size_t j) const {
    const PeerEstimate held = estimate(i, actors_[j].name);
    const Pose2 relative = actors_[i].odometry().inverse() * held.T_odom_peerodom.pose * actors_[j].odometry();
    return (actors_[i].T_world_base.inverse() * actors_[j].T_world_base).inverse() * relative;
  }
  Pose2 truth(std::size_t i, std::size_t j) const { return actors_[i].T_world_odom.inverse() * actors_[j].T_world_odom; }

  LidarModel lidar;
  double told_span = 0.25;  // [s] of sightings that a message is about
  std::vector<std::vector<PeerEstimate>> estimates;

 private:
  void tell(std::size_t from, std::size_t to) {
    const bool hears = links.empty() || std::find(links.begin(), links.end(), std::make_pair(from, to)) != links.end();
    if (from == to || !hears) return;
    Actor &sender = actors_[from], &receiver = actors_[to];
    receiver.localization.addPeerMotion(sender.name, sender.motion(now_));
    for (const SightReport& report : sender.localization.sights(now_ + sender.clock - told_span))
      receiver.localization.addPeerSights(sender.name, report);
    for (const Keyframe& keyframe : sender.localization.keyframes()) receiver.localization.addPeerKeyframe(sender.name, keyframe);
  }

  WallRange walls_;
  std::mt19937 random_;
  double now_ = 0.0;  // [s]
  int ticks_ = 0;     // [-]
  std::vector<Actor> actors_;
};

}  // namespace parley::test

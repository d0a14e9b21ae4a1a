// SPDX-License-Identifier: BSD-3-Clause
#include "drive_generator.h"

#include <algorithm>
#include <cmath>

#include "parley_geometry/polygon.h"

namespace parley {

namespace {

constexpr int kMostPasses = 8;         // simulations until the margins must be kept
constexpr double kBackOff = 0.03;      // [m] stop this much before what is too near
constexpr double kTrackBackOff = 0.2;  // [m] as above for what moves: it comes nearer while the robot brakes
constexpr double kPeerBackOff = 0.3;   // [m] as above for teammates: either may have to turn
constexpr double kSlack = 0.005;       // [m] by which a start that is too near may come nearer: lookups are no better
constexpr double kLastMargin = 0.01;   // [m]
constexpr double kSpeedSlack = 0.02;   // [m/s]

}  // namespace

DriveGenerator::DriveGenerator(const Footprint& footprint, const MotionLimits& limits, double time_step)
    : footprint_(footprint), probe_(footprint), limits_(limits), time_step_(time_step) {}

double peerClearance(const Footprint& footprint, const TrajectoryPoint& point, const PeerMotion& peer, double margin) {
  const Pose2 there = peer.trajectory.at(point.time).pose;
  const double kept = margin + uncertaintyOf(peer);
  const double apart = (there.position() - point.pose.position()).norm();
  const double far = apart - footprint.circumscribedRadius() - peer.footprint.circumscribedRadius() - kept;
  if (far > 1.0) return 1.0;
  return convexDistance(footprint.polygonAt(point.pose), peer.footprint.polygonAt(there)) - kept;
}

DriveGenerator::Floor DriveGenerator::floorAt(const TrajectoryPoint& start, const DriveScene& scene,
                                              const Margins& margins) const {
  const double obstacles = probe_.clearance(scene.surroundings.obstacles(), start.pose);
  const double unseen = probe_.clearance(scene.surroundings.unseen(), start.pose);
  // A start that lacks the creeping margin may lose a little more of it, but never again and again down to nothing.
  const double floor = obstacles < kLastMargin ? obstacles - 1e-3 : std::max(kLastMargin, obstacles - kSlack);
  return {std::min(margins.creeping, floor), std::min(0.0, unseen - kSlack),
          std::min(trackClearance(start, scene, start.time) - kSlack, scene.track_margin),
          std::min(0.0, peersClearance(start, scene) - kSlack)};
}

double DriveGenerator::peersClearance(const TrajectoryPoint& point, const DriveScene& scene) const {
  double least = 1.0;
  for (const PeerMotion& peer : scene.peers) {
    least = std::min(least, peerClearance(footprint_, point, peer, scene.peer_margin));
  }
  return least;
}

double DriveGenerator::trackClearance(const TrajectoryPoint& point, const DriveScene& scene, double start_time) const {
  double least = 1e3;
  if (point.time - start_time > scene.prediction_time) return least;
  for (const TrackedObject& track : scene.tracks) {
    if (!track.has_moved) continue;  // what never moved is in the scan like a wall
    const Eigen::Vector2d p_odom = track.position + track.velocity * (point.time - track.stamp);
    const Eigen::Vector2d p_base = point.pose.inverse() * p_odom;
    const double dx = std::max(0.0, std::abs(p_base.x()) - 0.5 * footprint_.length);
    const double dy = std::max(0.0, std::abs(p_base.y()) - 0.5 * footprint_.width);
    least = std::min(least, std::hypot(dx, dy) - track.radius);
  }
  return least;
}

SpeedProfile DriveGenerator::profileAlong(const ReferencePath& path, const DriveScene& scene, const Margins& margins,
                                          const std::vector<double>& sight_bounds) const {
  SpeedProfile profile(path, limits_);
  for (std::size_t i = 0; i < profile.size(); ++i) {
    if (i < sight_bounds.size()) profile.lower(i, sight_bounds[i]);
    const ReferencePath::Point point = path.at(profile.arcLengths()[i]);
    const Pose2 pose{point.position.x(), point.position.y(), point.yaw};
    const double room = probe_.clearance(scene.surroundings.obstacles(), pose);
    if (room < margins.at(limits_.speed)) profile.lower(i, std::max(margins.creep_speed, margins.speedFor(room)));
  }
  return profile;
}

DriveGenerator::Correction DriveGenerator::corrected(const PathDrive& drive, const SpeedProfile& profile, const DriveScene& scene,
                                                     const Margins& margins, const Floor& floor) const {
  Correction correction{profile, DriveEnd::kPathEnd, false};
  for (std::size_t k = 1; k < drive.points.size(); ++k) {
    const TrajectoryPoint& point = drive.points[k];
    const double s = drive.arc_lengths[k];
    const double room = probe_.clearance(scene.surroundings.obstacles(), point.pose);
    const bool hits = room < floor.obstacles;
    const bool strays = probe_.clearance(scene.surroundings.unseen(), point.pose) < floor.unseen;
    const bool meets = trackClearance(point, scene, drive.points.front().time) < floor.tracks;
    const bool bumps = peersClearance(point, scene) < floor.peers;
    if (hits || strays || meets || bumps) {
      const double back_off = bumps ? kPeerBackOff : (meets ? kTrackBackOff : kBackOff);
      correction.profile.stopAt(std::min(s, profile.stop()) - back_off);
      correction.end = hits ? DriveEnd::kObstacle : (strays ? DriveEnd::kUnseen : (meets ? DriveEnd::kTrack : DriveEnd::kPeer));
      correction.changed = true;
      break;
    }
    const double allowed = std::max(margins.creep_speed, margins.speedFor(room));
    if (std::abs(point.twist.speed) > allowed + kSpeedSlack) {
      correction.profile.lowerBetween(s - 0.15, s + 0.15, 0.97 * allowed);
      correction.changed = true;
    }
  }
  return correction;
}

GeneratedDrive DriveGenerator::along(const ReferencePath& path, const TrajectoryPoint& start, bool reverse,
                                     const DriveScene& scene, const Margins& margins,
                                     const std::vector<double>& sight_bounds) const {
  GeneratedDrive result;
  SpeedProfile profile = profileAlong(path, scene, margins, sight_bounds);
  const Floor floor = floorAt(start, scene, margins);
  DriveEnd end = DriveEnd::kPathEnd;
  for (int pass = 0; pass < kMostPasses; ++pass) {
    profile.spread();
    result.drive = followPath(path, profile, start, reverse, limits_, time_step_);
    Correction correction = corrected(result.drive, profile, scene, margins, floor);
    if (!correction.changed) {
      result.end = end;
      result.advance = result.drive.arc_lengths.back() - result.drive.arc_lengths.front();
      return result;
    }
    profile = std::move(correction.profile);
    if (correction.end != DriveEnd::kPathEnd) end = correction.end;
  }
  result.end = DriveEnd::kInfeasible;
  return result;
}

bool DriveGenerator::isFree(const std::vector<TrajectoryPoint>& points, const DriveScene& scene, const Margins& margins) const {
  const Floor floor = floorAt(points.front(), scene, margins);
  return std::all_of(points.begin(), points.end(), [&](const TrajectoryPoint& point) {
    return probe_.clearance(scene.surroundings.obstacles(), point.pose) >= floor.obstacles &&
           probe_.clearance(scene.surroundings.unseen(), point.pose) >= floor.unseen &&
           trackClearance(point, scene, points.front().time) >= floor.tracks && peersClearance(point, scene) >= floor.peers;
  });
}

std::vector<TrajectoryPoint> DriveGenerator::turn(const TrajectoryPoint& start, double yaw, const DriveScene& scene,
                                                  const Margins& margins) const {
  std::vector<TrajectoryPoint> points = turnOnSpot(start, yaw, limits_, time_step_);
  // The longer way round would need no less room: over half a turn the corners sweep all of the circle.
  return isFree(points, scene, margins) ? points : std::vector<TrajectoryPoint>{};
}

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#include "peer_tube.h"

#include <algorithm>
#include <cmath>

#include "parley_geometry/polygon.h"

namespace parley {

namespace {

constexpr double kLongestWay = 8.0;      // [m] further ahead nobody needs to make room
constexpr double kOffWay = 1.0;          // [m] a peer so far off the way that it told of is not on it any more
constexpr double kAgainst = 0.5;         // [-] cosine of the angle between two directions, above which they are the same
constexpr double kHeadOn = -0.5;         // [-] and below which they are opposite
constexpr double kHeadOnLength = 0.8;    // [m]
constexpr double kWallGap = 0.08;        // [m] that a peer keeps from the wall on its right
constexpr double kSidewaysStep = 0.05;   // [m]
constexpr double kStandingSpeed = 0.05;  // [m/s]

Eigen::Vector2d directionAt(const Path& way, std::size_t i) {
  const std::size_t a = i > 0 ? i - 1 : 0, b = std::min(i + 1, way.size() - 1);
  const Eigen::Vector2d step = way[b] - way[a];
  return step.norm() > 1e-6 ? Eigen::Vector2d(step.normalized()) : Eigen::Vector2d::Zero();
}

struct Nearest {
  std::size_t index = 0;
  double distance = 1e3;  // [m]
};

Nearest nearestOn(const Path& way, const Eigen::Vector2d& p) {
  Nearest nearest;
  double best = 1e12;
  for (std::size_t i = 0; i < way.size(); ++i) {
    const double d = (way[i] - p).squaredNorm();
    if (d >= best) continue;
    best = d;
    nearest.index = i;
  }
  nearest.distance = std::sqrt(best);
  return nearest;
}

}  // namespace

Path wayFrom(const Path& way, const Eigen::Vector2d& p, double reach) {
  Path rest = {p};
  if (way.empty()) return rest;
  // The nearest place may be in the middle of a long segment.
  std::size_t segment = 0;
  double best = 1e12;
  for (std::size_t i = 0; i + 1 < way.size(); ++i) {
    const double d = pointSegmentDistance(p, way[i], way[i + 1]);
    if (d >= best - 1e-9) continue;
    best = d;
    segment = i;
  }
  double left = reach;
  for (std::size_t i = segment + 1; i < way.size() && left > 0.0; ++i) {
    const Eigen::Vector2d step = way[i] - rest.back();
    if (step.norm() < 1e-3) continue;
    const double length = std::min(left, step.norm());
    rest.emplace_back(rest.back() + step.normalized() * length);
    left -= length;
  }
  return rest.size() < 2 ? rest : resampled(rest, kTubeStep);
}

PeerTube tubeOf(const PeerMotion& peer, double now, double margin) {
  const TrajectoryPoint present = peer.trajectory.at(now);
  PeerTube tube{peer.id, peer.intent.right, peer.footprint, present.pose, present.twist.speed, {}, margin, false, false};
  const TrajectoryPoint& end = peer.trajectory.points().back();
  tube.standing = std::abs(present.twist.speed) < kStandingSpeed && (end.pose.position() - present.pose.position()).norm() < 0.1;
  tube.way = wayFrom(peer.intent.way, present.pose.position(), kLongestWay);
  const bool told =
      peer.intent.way.size() > 1 && nearestOn(resampled(peer.intent.way, kTubeStep), tube.way[0]).distance < kOffWay;
  if (told) return tube;
  Path driven;
  if (now < peer.trajectory.endTime()) {
    const SampledTrajectory rest = peer.trajectory.from(now);
    for (const TrajectoryPoint& point : rest.points()) driven.push_back(point.pose.position());
  }
  tube.way = wayFrom(driven, present.pose.position(), kLongestWay);
  return tube;
}

TubePlace placeIn(const PeerTube& tube, const Eigen::Vector2d& p) {
  const Nearest nearest = nearestOn(tube.way, p);
  return {nearest.distance, kTubeStep * static_cast<double>(nearest.index), directionAt(tube.way, nearest.index)};
}

std::optional<Meeting> meetingOf(const Path& way, const PeerTube& tube, double distance) {
  std::optional<Meeting> meeting;
  double opposite = 0.0;
  for (std::size_t i = 0; i < way.size(); ++i) {
    const Nearest nearest = nearestOn(tube.way, way[i]);
    const double s = kTubeStep * static_cast<double>(i), along = kTubeStep * static_cast<double>(nearest.index);
    if (nearest.distance > distance) {
      if (meeting && s > meeting->leaves + 0.5) break;
      continue;
    }
    if (!meeting) meeting = Meeting{s, s, along, false, false};
    meeting->leaves = s;
    meeting->peer_enters = std::min(meeting->peer_enters, along);
    const double cosine = directionAt(way, i).dot(directionAt(tube.way, nearest.index));
    if (cosine < kAgainst) meeting->against = true;
    if (cosine < kHeadOn) opposite += kTubeStep;
  }
  if (meeting) meeting->head_on = opposite > kHeadOnLength;
  return meeting;
}

Path keepingRight(const PeerTube& tube, const Path& way, double separation, const DistanceField& obstacles) {
  const double needed = 0.5 * tube.footprint.width + kWallGap;
  Path moved;
  for (std::size_t i = 0; i < tube.way.size(); ++i) {
    const Eigen::Vector2d direction = directionAt(tube.way, i);
    const Eigen::Vector2d right(direction.y(), -direction.x());
    const double lack = std::max(0.0, 0.5 * (separation - nearestOn(way, tube.way[i]).distance));
    double shift = 0.0;
    while (shift + kSidewaysStep <= lack && obstacles.at(tube.way[i] + (shift + kSidewaysStep) * right) >= needed) {
      shift += kSidewaysStep;
    }
    moved.emplace_back(tube.way[i] + shift * right);
  }
  return moved;
}

}  // namespace parley

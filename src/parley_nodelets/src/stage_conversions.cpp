// SPDX-License-Identifier: BSD-3-Clause
#include "parley_nodelets/stage_conversions.h"

#include <algorithm>
#include <cmath>

#include "parley_nodelets/sensor_conversions.h"

namespace parley {
namespace {

geometry_msgs::Point toPoint(const Eigen::Vector2d& p) {
  geometry_msgs::Point point;
  point.x = p.x();
  point.y = p.y();
  return point;
}

Eigen::Vector2d fromPoint(const geometry_msgs::Point& point) { return {point.x, point.y}; }

}  // namespace

parley_msgs::ObstacleScan toMessage(const ObstacleScan& scan, const std::string& base_frame) {
  parley_msgs::ObstacleScan message;
  message.header = headerOf(scan.stamp, base_frame);
  message.range_max = scan.range_max;
  message.origin = toPoint(scan.origin);
  message.ranges = scan.ranges;
  message.transient.assign(scan.transient.begin(), scan.transient.end());
  message.moving.assign(scan.moving.begin(), scan.moving.end());
  message.points.resize(scan.points.size());
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    message.points[i].x = scan.points[i].x();
    message.points[i].y = scan.points[i].y();
  }
  for (const Blob& blob : scan.blobs) {
    parley_msgs::Blob& part = message.blobs.emplace_back();
    part.position = toPoint(blob.position);
    part.chord = blob.chord;
    part.beams = blob.beams;
  }
  return message;
}

std::optional<ObstacleScan> fromMessage(const parley_msgs::ObstacleScan& message) {
  ObstacleScan scan;
  scan.stamp = message.header.stamp.toSec();
  scan.range_max = message.range_max;
  scan.origin = fromPoint(message.origin);
  scan.ranges = message.ranges;
  scan.transient.assign(message.transient.begin(), message.transient.end());
  scan.moving.assign(message.moving.begin(), message.moving.end());
  const bool usable = !scan.ranges.empty() && scan.transient.size() == scan.ranges.size() &&
                      scan.moving.size() == scan.ranges.size() && scan.origin.allFinite() && std::isfinite(scan.range_max) &&
                      scan.range_max > 0.0;
  if (!usable) return std::nullopt;
  for (const geometry_msgs::Point32& point : message.points) {
    if (!std::isfinite(point.x) || !std::isfinite(point.y)) return std::nullopt;
    scan.points.emplace_back(point.x, point.y);
  }
  for (const parley_msgs::Blob& blob : message.blobs) {
    if (!fromPoint(blob.position).allFinite() || !std::isfinite(blob.chord)) return std::nullopt;
    scan.blobs.push_back({fromPoint(blob.position), blob.chord, blob.beams});
  }
  return scan;
}

parley_msgs::TrackedObjects toMessage(const std::vector<TrackedObject>& tracks, double stamp, const std::string& odom_frame) {
  parley_msgs::TrackedObjects message;
  message.header = headerOf(stamp, odom_frame);
  for (const TrackedObject& track : tracks) {
    parley_msgs::TrackedObject& object = message.objects.emplace_back();
    object.id = track.id;
    object.stamp = toRosTime(track.stamp);
    object.position = toPoint(track.position);
    object.velocity.x = track.velocity.x();
    object.velocity.y = track.velocity.y();
    object.radius = track.radius;
    object.observations = track.observations;
    object.moving = track.moving;
    object.has_moved = track.has_moved;
  }
  return message;
}

std::optional<std::vector<TrackedObject>> fromMessage(const parley_msgs::TrackedObjects& message) {
  std::vector<TrackedObject> tracks;
  for (const parley_msgs::TrackedObject& object : message.objects) {
    TrackedObject track;
    track.id = object.id;
    track.stamp = object.stamp.toSec();
    track.position = fromPoint(object.position);
    track.velocity = {object.velocity.x, object.velocity.y};
    track.radius = object.radius;
    track.observations = object.observations;
    track.moving = object.moving;
    track.has_moved = object.has_moved;
    if (!track.position.allFinite() || !track.velocity.allFinite() || !(track.radius >= 0.0)) return std::nullopt;
    tracks.push_back(track);
  }
  return tracks;
}

parley_msgs::Route toMessage(const RouteToGoal& route, double stamp, const std::string& odom_frame) {
  parley_msgs::Route message;
  message.header = headerOf(stamp, odom_frame);
  message.verdict = static_cast<std::uint8_t>(route.route.verdict);
  message.goal = toPoint(route.goal);
  for (const Eigen::Vector2d& p : route.route.points) message.points.push_back(toPoint(p));
  message.length = route.route.length;
  message.cost = route.route.cost;
  message.narrowest = route.route.narrowest;
  message.switches = route.route.switches;
  return message;
}

std::optional<RouteToGoal> fromMessage(const parley_msgs::Route& message) {
  if (message.verdict > parley_msgs::Route::UNREACHABLE_AS_KNOWN) return std::nullopt;
  RouteToGoal route;
  route.goal = fromPoint(message.goal);
  route.route.verdict = static_cast<RouteVerdict>(message.verdict);
  for (const geometry_msgs::Point& point : message.points) {
    if (!fromPoint(point).allFinite()) return std::nullopt;
    route.route.points.push_back(fromPoint(point));
  }
  route.route.length = message.length;
  route.route.cost = message.cost;
  route.route.narrowest = message.narrowest;
  route.route.switches = message.switches;
  return route;
}

parley_msgs::RobotState toMessage(const ControlResult& result, double stamp, const std::string& base_frame) {
  parley_msgs::RobotState message;
  message.header = headerOf(stamp, base_frame);
  message.state = static_cast<std::uint8_t>(result.state);
  message.name = toString(result.state);
  message.reason = result.reason;
  message.emergency = result.emergency;
  message.speed = result.twist.speed;
  message.turn_rate = result.twist.turn_rate;
  return message;
}

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#include "parley_nodelets/motion_conversions.h"

#include <algorithm>
#include <cmath>

#include "parley_nodelets/sensor_conversions.h"

namespace parley {
namespace {

bool isFinite(const parley_msgs::TrajectoryPoint& point) {
  return std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.yaw) && std::isfinite(point.speed) &&
         std::isfinite(point.turn_rate);
}

std::vector<parley_msgs::TrajectoryPoint> toMessage(const SampledTrajectory& trajectory) {
  std::vector<parley_msgs::TrajectoryPoint> points;
  for (const TrajectoryPoint& point : trajectory.points()) {
    parley_msgs::TrajectoryPoint& part = points.emplace_back();
    part.stamp = toRosTime(point.time);
    part.x = point.pose.x;
    part.y = point.pose.y;
    part.yaw = point.pose.yaw;
    part.speed = point.twist.speed;
    part.turn_rate = point.twist.turn_rate;
  }
  return points;
}

std::optional<SampledTrajectory> fromMessage(const std::vector<parley_msgs::TrajectoryPoint>& parts) {
  std::vector<TrajectoryPoint> points;
  for (const parley_msgs::TrajectoryPoint& part : parts) {
    const double time = part.stamp.toSec();
    if (!isFinite(part) || (!points.empty() && time < points.back().time)) return std::nullopt;
    points.push_back({time, {part.x, part.y, part.yaw}, {part.speed, part.turn_rate}});
  }
  return SampledTrajectory(std::move(points));
}

parley_msgs::Intent toMessage(const Intent& intent) {
  parley_msgs::Intent message;
  message.priority = intent.right.priority;
  message.holder = intent.right.holder;
  message.depth = static_cast<std::uint8_t>(std::clamp(intent.right.depth, 0, 255));
  for (const Eigen::Vector2d& corner : intent.way) {
    geometry_msgs::Point& point = message.way.emplace_back();
    point.x = corner.x();
    point.y = corner.y();
  }
  return message;
}

std::optional<Intent> fromMessage(const parley_msgs::Intent& message) {
  Intent intent{{message.priority, message.holder, message.depth}, {}};
  if (!std::isfinite(message.priority)) return std::nullopt;
  for (const geometry_msgs::Point& point : message.way) {
    if (!std::isfinite(point.x) || !std::isfinite(point.y)) return std::nullopt;
    intent.way.emplace_back(point.x, point.y);
  }
  return intent;
}

std::optional<PeerMotion> fromMessage(const parley_msgs::PeerMotion& message) {
  const std::optional<SampledTrajectory> trajectory = fromMessage(message.trajectory);
  const std::optional<Intent> intent = fromMessage(message.intent);
  const bool usable = trajectory && !trajectory->empty() && intent && std::isfinite(message.length) && message.length > 0.0 &&
                      std::isfinite(message.width) && message.width > 0.0 && std::isfinite(message.sigma) && message.sigma >= 0.0;
  if (!usable) return std::nullopt;
  return PeerMotion{message.id, {message.length, message.width}, *trajectory, message.heard.toSec(), message.sigma, *intent};
}

}  // namespace

parley_msgs::Trajectory toMessage(const TimedPlan& plan, const std::string& odom_frame) {
  parley_msgs::Trajectory message;
  message.header = headerOf(plan.made_at, odom_frame);
  message.verdict = static_cast<std::uint8_t>(plan.result.status.code);
  message.text = plan.result.status.text;
  message.start = toRosTime(plan.start_time);
  message.keep_committed = plan.result.keep_committed;
  message.intent = toMessage(plan.result.intent);
  if (!message.keep_committed) message.points = toMessage(plan.result.trajectory);
  return message;
}

std::optional<TimedPlan> fromMessage(const parley_msgs::Trajectory& message) {
  std::optional<SampledTrajectory> trajectory = fromMessage(message.points);
  std::optional<Intent> intent = fromMessage(message.intent);
  if (!trajectory || !intent || message.verdict > parley_msgs::Trajectory::ESCAPING) return std::nullopt;
  TimedPlan plan;
  plan.made_at = message.header.stamp.toSec();
  plan.start_time = message.start.toSec();
  plan.result.status = {static_cast<PlanCode>(message.verdict), message.text};
  plan.result.keep_committed = message.keep_committed;
  plan.result.trajectory = std::move(*trajectory);
  plan.result.intent = std::move(*intent);
  return plan;
}

parley_msgs::PeerMotions toMessage(const TeamMotions& motions, const std::map<RobotId, Teammate>& names,
                                   const std::string& odom_frame) {
  parley_msgs::PeerMotions message;
  message.header = headerOf(motions.stamp, odom_frame);
  message.id = motions.id;
  message.team_known = motions.team_known;
  for (const PeerMotion& peer : motions.peers) {
    parley_msgs::PeerMotion& part = message.peers.emplace_back();
    const auto named = names.find(peer.id);
    part.id = peer.id;
    part.name = named != names.end() ? named->second.name : "";
    part.length = peer.footprint.length;
    part.width = peer.footprint.width;
    part.trajectory = toMessage(peer.trajectory);
    part.heard = toRosTime(peer.heard);
    part.sigma = peer.sigma;
    part.intent = toMessage(peer.intent);
  }
  return message;
}

std::optional<TeamMotions> fromMessage(const parley_msgs::PeerMotions& message) {
  TeamMotions motions{message.header.stamp.toSec(), message.id, message.team_known != 0, {}};
  for (const parley_msgs::PeerMotion& part : message.peers) {
    std::optional<PeerMotion> peer = fromMessage(part);
    if (!peer) return std::nullopt;
    motions.peers.push_back(std::move(*peer));
  }
  return motions;
}

TeamMotions motionsOf(const TeamLink& team, double now) { return {now, team.id(), team.isTeamKnown(now), team.motions(now)}; }

nav_msgs::Path toPath(const SampledTrajectory& trajectory, double stamp, const std::string& odom_frame) {
  nav_msgs::Path path;
  path.header = headerOf(stamp, odom_frame);
  for (const TrajectoryPoint& point : trajectory.points()) {
    geometry_msgs::PoseStamped& pose = path.poses.emplace_back();
    pose.header = headerOf(point.time, odom_frame);
    pose.pose = toPose(point.pose);
  }
  return path;
}

}  // namespace parley

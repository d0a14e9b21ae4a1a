// SPDX-License-Identifier: BSD-3-Clause
#include "parley_nodelets/team_conversions.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>

#include "parley_nodelets/sensor_conversions.h"

namespace parley {
namespace {

std::optional<Pose2> fromPose(const geometry_msgs::Pose& message) {
  const std::optional<Attitude> attitude = attitudeOf(message.orientation);
  if (!attitude || !std::isfinite(message.position.x) || !std::isfinite(message.position.y)) return std::nullopt;
  return Pose2{message.position.x, message.position.y, attitude->yaw};
}

void addCorners(const Polygon& polygon, parley_msgs::Contour& message) {
  for (const Eigen::Vector2d& corner : polygon) {
    geometry_msgs::Point& point = message.points.emplace_back();
    point.x = corner.x();
    point.y = corner.y();
  }
}

std::optional<Polygon> cornersOf(const parley_msgs::Contour& message) {
  Polygon polygon;
  for (const geometry_msgs::Point& point : message.points) {
    if (!std::isfinite(point.x) || !std::isfinite(point.y)) return std::nullopt;
    polygon.emplace_back(point.x, point.y);
  }
  return polygon;
}

bool isFrameName(const std::string& name) {
  const auto isPlain = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.'; };
  return !name.empty() && std::all_of(name.begin(), name.end(), isPlain);
}

geometry_msgs::PoseWithCovariance toPose(const PoseEstimate& estimate) {
  constexpr std::array<std::size_t, 3> kRows{0, 1, 5};  // x, y, yaw of six
  geometry_msgs::PoseWithCovariance message;
  message.pose = toPose(estimate.pose);
  for (std::size_t row = 0; row < kRows.size(); ++row) {
    for (std::size_t column = 0; column < kRows.size(); ++column) {
      message.covariance[kRows[row] * 6 + kRows[column]] =
          estimate.covariance(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column));
    }
  }
  return message;
}

parley_msgs::Peer toMessage(const Teammate& teammate, const std::string& odom_frame) {
  parley_msgs::Peer peer;
  peer.id = teammate.id;
  peer.name = teammate.name;
  peer.state = static_cast<std::uint8_t>(teammate.estimate.state);
  if (teammate.estimate.state == PoseState::kConfirmed) peer.frame = peerFrame(odom_frame, teammate);
  peer.pose = toPose(teammate.estimate.T_odom_peerodom);
  peer.age = teammate.estimate.age;
  peer.support = teammate.estimate.support;
  peer.direct = teammate.estimate.direct;
  return peer;
}

}  // namespace

std::string peerFrame(const std::string& odom_frame, const Teammate& teammate) {
  const std::size_t slash = odom_frame.rfind('/');
  const std::string prefix = slash == std::string::npos ? "" : odom_frame.substr(0, slash + 1);
  char number[16];
  std::snprintf(number, sizeof(number), "%08x", teammate.id);
  return prefix + "peer/" + (isFrameName(teammate.name) ? teammate.name : number) + "/odom";
}

parley_msgs::Contours toMessage(const std::vector<Contour>& contours, const std::vector<SeenThrough>& seen_through, double stamp,
                                const std::string& odom_frame) {
  parley_msgs::Contours message;
  message.header = headerOf(stamp, odom_frame);
  for (const SeenThrough& outline : seen_through) {
    parley_msgs::SeenThrough& part = message.seen_through.emplace_back();
    part.origin = outline.origin;
    part.id = outline.id;
    part.version = outline.version;
  }
  for (const Contour& contour : contours) {
    parley_msgs::Contour& part = message.contours.emplace_back();
    addCorners(contour.polygon, part);
    part.closed = contour.closed;
    part.hole = contour.hole;
    part.tile_x = contour.tile.x();
    part.tile_y = contour.tile.y();
    part.piece = contour.piece;
  }
  return message;
}

std::optional<std::vector<Contour>> fromMessage(const parley_msgs::Contours& message) {
  std::vector<Contour> contours;
  for (const parley_msgs::Contour& part : message.contours) {
    std::optional<Polygon> polygon = cornersOf(part);
    if (!polygon) return std::nullopt;
    contours.push_back({std::move(*polygon), part.hole != 0, part.closed != 0, {part.tile_x, part.tile_y}, part.piece});
  }
  return contours;
}

std::vector<SeenThrough> seenThroughOf(const parley_msgs::Contours& message) {
  std::vector<SeenThrough> outlines;
  for (const parley_msgs::SeenThrough& part : message.seen_through) outlines.push_back({part.origin, part.id, part.version});
  return outlines;
}

parley_msgs::Contour toMessage(const Refuted& outline) {
  parley_msgs::Contour message;
  addCorners(outline.polygon, message);
  message.closed = outline.closed;
  message.stamp = toRosTime(std::max(0.0, outline.before));
  return message;
}

std::optional<Refuted> refutedOf(const parley_msgs::Contour& message) {
  std::optional<Polygon> polygon = cornersOf(message);
  if (!polygon) return std::nullopt;
  return Refuted{std::move(*polygon), message.closed != 0, message.stamp.toSec()};
}

parley_msgs::MapLayer toMessage(const LayerUpdate& layer) {
  parley_msgs::MapLayer message;
  message.origin = layer.origin;
  message.hops = layer.hops;
  message.stamp = toRosTime(layer.stamp);
  message.T_odom_peer = toPose(layer.T_odom_peer);
  message.obstacle = layer.obstacle;
  for (const LayerContour& contour : layer.contours) {
    parley_msgs::Contour& part = message.contours.emplace_back();
    addCorners(contour.polygon, part);
    part.closed = contour.closed;
    part.stamp = toRosTime(std::max(0.0, contour.stamp));
    part.id = contour.id;
    part.version = contour.version;
  }
  return message;
}

std::optional<LayerUpdate> fromMessage(const parley_msgs::MapLayer& message) {
  const std::optional<Pose2> pose = fromPose(message.T_odom_peer);
  if (!pose || message.origin.empty()) return std::nullopt;
  LayerUpdate layer{message.origin, message.hops, message.stamp.toSec(), *pose, message.obstacle != 0, {}};
  for (const parley_msgs::Contour& part : message.contours) {
    std::optional<Polygon> polygon = cornersOf(part);
    if (!polygon) return std::nullopt;
    const double stamp = part.stamp.isZero() ? LayerContour{}.stamp : part.stamp.toSec();
    layer.contours.push_back({std::move(*polygon), part.closed != 0, stamp, part.id, part.version});
  }
  return layer;
}

parley_msgs::Teammates toMessage(const std::vector<KnownTeammate>& bodies, double stamp, const std::string& odom_frame) {
  parley_msgs::Teammates message;
  message.header = headerOf(stamp, odom_frame);
  for (const KnownTeammate& body : bodies) {
    parley_msgs::Teammate& part = message.teammates.emplace_back();
    part.pose = toPose(body.pose_odom);
    part.length = body.footprint.length;
    part.width = body.footprint.width;
    part.margin = body.margin;
  }
  return message;
}

std::optional<std::vector<KnownTeammate>> fromMessage(const parley_msgs::Teammates& message) {
  std::vector<KnownTeammate> bodies;
  for (const parley_msgs::Teammate& part : message.teammates) {
    const std::optional<Pose2> pose = fromPose(part.pose);
    const bool usable = pose && std::isfinite(part.length) && part.length > 0.0 && std::isfinite(part.width) &&
                        part.width > 0.0 && std::isfinite(part.margin) && part.margin >= 0.0;
    if (!usable) return std::nullopt;
    bodies.push_back({*pose, {part.length, part.width}, part.margin});
  }
  return bodies;
}

parley_msgs::PeerArray peersOf(const TeamLink& team, double now, const std::string& odom_frame) {
  parley_msgs::PeerArray message;
  message.header = headerOf(now, odom_frame);
  message.id = team.exchange().id();
  message.bytes_sent = team.exchange().counters().bytes_sent;
  std::map<RobotId, PeerState> heard;
  for (PeerState& state : team.exchange().peers(now)) heard[state.id] = std::move(state);
  for (const auto& [id, teammate] : team.teammates()) {
    parley_msgs::Peer& peer = message.peers.emplace_back(toMessage(teammate, odom_frame));
    const auto state = heard.find(id);
    if (state == heard.end()) continue;
    peer.neighbour = state->second.neighbour;
    peer.last_heard = toRosTime(state->second.last_heard);
    peer.heard = state->second.heard;
    peer.heard_there = state->second.heard_there;
  }
  return message;
}

}  // namespace parley

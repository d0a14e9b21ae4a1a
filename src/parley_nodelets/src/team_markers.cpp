// SPDX-License-Identifier: BSD-3-Clause
#include "parley_nodelets/team_markers.h"

#include "marker_drawing.h"
#include "parley_nodelets/sensor_conversions.h"
#include "parley_nodelets/team_conversions.h"

namespace parley {
namespace {

using visualization_msgs::Marker;

std::vector<Eigen::Vector2d> brought(const Pose2& T, std::vector<Eigen::Vector2d> points) {
  for (Eigen::Vector2d& p : points) p = T * p;
  return points;
}

Drawing drawLayers(const std::map<std::string, parley_msgs::MapLayer>& layers, bool obstacles, std::size_t most_points) {
  const std_msgs::ColorRGBA c = obstacles ? colour(0.0F, 0.45F, 0.7F, 1.0F) : colour(0.0F, 0.45F, 0.7F, 0.35F);
  Drawing drawing(Marker::LINE_LIST, obstacles ? "maps" : "maps in doubt", 0.06, c, most_points);
  for (const auto& [origin, message] : layers) {
    const std::optional<LayerUpdate> layer = fromMessage(message);
    if (!layer || layer->obstacle != obstacles) continue;
    for (const LayerContour& contour : layer->contours) {
      drawing.chain(brought(layer->T_odom_peer, contour.polygon), contour.closed);
    }
  }
  return drawing;
}

/// The rectangle, and a line from its middle to its front.
void drawBody(const DrawnPeer& peer, Drawing& drawing) {
  const double x = 0.5 * peer.footprint.length, y = 0.5 * peer.footprint.width;
  drawing.chain(brought(peer.pose_odom, {{x, y}, {-x, y}, {-x, -y}, {x, -y}}), true);
  drawing.line(peer.pose_odom.position(), peer.pose_odom * Eigen::Vector2d(x, 0.0));
}

Drawing drawBodies(const std::vector<DrawnPeer>& peers, bool confirmed, std::size_t most_points) {
  const std_msgs::ColorRGBA c = confirmed ? colour(0.0F, 0.6F, 0.2F, 1.0F) : colour(0.5F, 0.5F, 0.5F, 0.8F);
  Drawing drawing(Marker::LINE_LIST, confirmed ? "peers" : "peers in doubt", 0.05, c, most_points);
  for (const DrawnPeer& peer : peers) {
    if ((peer.state == PoseState::kConfirmed) == confirmed) drawBody(peer, drawing);
  }
  return drawing;
}

Drawing drawPlans(const std::vector<DrawnPeer>& peers, std::size_t most_points) {
  Drawing drawing(Marker::LINE_LIST, "plans", 0.05, colour(0.8F, 0.45F, 0.0F, 1.0F), most_points);
  for (const DrawnPeer& peer : peers) drawing.chain(peer.plan_odom, false);
  return drawing;
}

Drawing drawWays(const std::vector<DrawnPeer>& peers, bool make_room, std::size_t most_points) {
  const std_msgs::ColorRGBA c = make_room ? colour(0.9F, 0.2F, 0.6F, 1.0F) : colour(0.0F, 0.6F, 0.2F, 1.0F);
  Drawing drawing(Marker::LINE_LIST, make_room ? "ways of those who make room" : "ways", 0.02, c, most_points);
  for (const DrawnPeer& peer : peers) {
    if (peer.goes_first.empty() != make_room) drawing.chain(peer.way_odom, false);
  }
  return drawing;
}

Marker nameOf(const DrawnPeer& peer, int id, const std_msgs::Header& header) {
  Marker marker;
  marker.header = header;
  marker.ns = "names";
  marker.id = id;
  marker.type = Marker::TEXT_VIEW_FACING;
  marker.pose = toPose(peer.pose_odom);
  marker.pose.position.z = 0.5;
  marker.scale.z = 0.4;
  marker.color = colour(0.1F, 0.1F, 0.1F, 1.0F);
  marker.text = peer.name;
  if (peer.state != PoseState::kConfirmed) marker.text += std::string("\n") + toString(peer.state);
  if (!peer.goes_first.empty()) marker.text += "\nmakes room for " + peer.goes_first;
  return marker;
}

/// As people call a robot.
std::string nameOf(const TeamLink& team, RobotId id) {
  if (id == team.id()) return "this robot";
  const auto found = team.teammates().find(id);
  return found != team.teammates().end() && !found->second.name.empty() ? found->second.name : "another";
}

}  // namespace

std::vector<DrawnPeer> drawnPeers(const TeamLink& team, double now) {
  std::vector<DrawnPeer> drawn;
  for (const PeerState& peer : team.exchange().peers(now)) {
    const auto found = team.teammates().find(peer.id);
    if (found == team.teammates().end() || found->second.estimate.state == PoseState::kUnknown || !peer.neighbour) continue;
    const Pose2& T = found->second.estimate.T_odom_peerodom.pose;
    drawn.push_back({found->second.name, found->second.estimate.state, T * peer.odometry.pose, peer.footprint, {}, {}, ""});
    if (const std::optional<PeerIntent> told = team.exchange().intentOf(peer.id)) {
      drawn.back().way_odom = brought(T, told->intent.way);
      if (told->intent.depth > 0) drawn.back().goes_first = nameOf(team, told->intent.holder);
    }
    const std::optional<PeerTrajectory> plan = team.exchange().trajectoryOf(peer.id, now);
    if (!plan) continue;
    for (const TrajectoryPoint& point : plan->trajectory.points()) drawn.back().plan_odom.push_back(T * point.pose.position());
  }
  return drawn;
}

visualization_msgs::MarkerArray teamMarkers(const std::vector<DrawnPeer>& peers,
                                            const std::map<std::string, parley_msgs::MapLayer>& layers, double stamp,
                                            const std::string& odom_frame, std::size_t most_points) {
  std_msgs::Header header;
  header.stamp = toRosTime(stamp);
  header.frame_id = odom_frame;
  visualization_msgs::MarkerArray markers;
  markers.markers.resize(1);
  markers.markers[0].header = header;
  markers.markers[0].action = Marker::DELETEALL;  // peers come and go
  for (const bool sure : {true, false}) {
    markers.markers.push_back(drawLayers(layers, sure, most_points).finished(header));
    markers.markers.push_back(drawBodies(peers, sure, most_points).finished(header));
    markers.markers.push_back(drawWays(peers, sure, most_points).finished(header));
  }
  markers.markers.push_back(drawPlans(peers, most_points).finished(header));
  for (std::size_t i = 0; i < peers.size(); ++i) markers.markers.push_back(nameOf(peers[i], static_cast<int>(i), header));
  return markers;
}

}  // namespace parley

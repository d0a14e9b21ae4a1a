// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <parley_msgs/MapLayer.h>
#include <visualization_msgs/MarkerArray.h>

#include <map>
#include <string>
#include <vector>

#include "parley_robot/team_link.h"

namespace parley {

/// A peer as it is drawn: where it is believed to be.
struct DrawnPeer {
  std::string name;
  PoseState state = PoseState::kUnknown;
  Pose2 pose_odom;
  Footprint footprint;
  std::vector<Eigen::Vector2d> plan_odom;  // [m] the trajectory that it has told
  std::vector<Eigen::Vector2d> way_odom;   // [m] where it means to go
  std::string goes_first;                  // for whom it makes room; empty: for nobody
};

/// All neighbours for whose pose there is at least a candidate.
std::vector<DrawnPeer> drawnPeers(const TeamLink& team, double now);

/// What RViz shows of the team: outlines of peers' maps, of those that only make crossing dearer apart, the bodies of peers,
/// green where confirmed and grey otherwise, with their names, where they are about to drive and, thinner, mean to go, in
/// another colour those who make room, and for whom. Each message replaces the one before; a line marker holds at most
/// `most_points` points.
visualization_msgs::MarkerArray teamMarkers(const std::vector<DrawnPeer>& peers,
                                            const std::map<std::string, parley_msgs::MapLayer>& layers, double stamp,
                                            const std::string& odom_frame, std::size_t most_points);

}  // namespace parley

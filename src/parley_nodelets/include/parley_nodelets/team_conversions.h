// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <parley_msgs/Contours.h>
#include <parley_msgs/MapLayer.h>
#include <parley_msgs/PeerArray.h>
#include <parley_msgs/Teammates.h>

#include <optional>
#include <string>
#include <vector>

#include "parley_lidar/lidar_stage.h"
#include "parley_robot/team_link.h"
#include "parley_topology/contour.h"

namespace parley {

/// The odom frame of a teammate in this robot's tf: `peer/<name>/odom`, with the prefix that the own odom frame has. A name
/// that would not do as part of a frame's, or is not known, gives way to the number.
std::string peerFrame(const std::string& odom_frame, const Teammate& teammate);

parley_msgs::Contours toMessage(const std::vector<Contour>& contours, const std::vector<SeenThrough>& seen_through, double stamp,
                                const std::string& odom_frame);
parley_msgs::Contour toMessage(const Refuted& outline);
parley_msgs::MapLayer toMessage(const LayerUpdate& layer);
parley_msgs::Teammates toMessage(const std::vector<KnownTeammate>& bodies, double stamp, const std::string& odom_frame);
/// All that a robot knows of its team.
parley_msgs::PeerArray peersOf(const TeamLink& team, double now, const std::string& odom_frame);

/// From messages: nullopt if something is not finite, no rotation, without size or without an origin.
std::optional<std::vector<Contour>> fromMessage(const parley_msgs::Contours& message);
std::vector<SeenThrough> seenThroughOf(const parley_msgs::Contours& message);
std::optional<Refuted> refutedOf(const parley_msgs::Contour& message);
std::optional<LayerUpdate> fromMessage(const parley_msgs::MapLayer& message);
std::optional<std::vector<KnownTeammate>> fromMessage(const parley_msgs::Teammates& message);

}  // namespace parley

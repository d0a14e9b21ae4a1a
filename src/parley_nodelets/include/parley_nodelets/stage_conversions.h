// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <parley_msgs/ObstacleScan.h>
#include <parley_msgs/RobotState.h>
#include <parley_msgs/Route.h>
#include <parley_msgs/TrackedObjects.h>

#include <optional>
#include <string>
#include <vector>

#include "parley_control/controller.h"
#include "parley_geometry/route.h"
#include "parley_geometry/scan.h"
#include "parley_geometry/tracked_object.h"

namespace parley {

/// A route and the goal that it was asked for.
struct RouteToGoal {
  Route route;
  Eigen::Vector2d goal = Eigen::Vector2d::Zero();  // [m] odom frame
};

/// From messages: nullopt if they are inconsistent (sizes, unknown constants) or hold what is not finite where it must
/// be.
std::optional<ObstacleScan> fromMessage(const parley_msgs::ObstacleScan& message);
std::optional<std::vector<TrackedObject>> fromMessage(const parley_msgs::TrackedObjects& message);
std::optional<RouteToGoal> fromMessage(const parley_msgs::Route& message);

parley_msgs::ObstacleScan toMessage(const ObstacleScan& scan, const std::string& base_frame);
parley_msgs::TrackedObjects toMessage(const std::vector<TrackedObject>& tracks, double stamp, const std::string& odom_frame);
parley_msgs::Route toMessage(const RouteToGoal& route, double stamp, const std::string& odom_frame);
parley_msgs::RobotState toMessage(const ControlResult& result, double stamp, const std::string& base_frame);

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include <memory>

#include "parley_nodelets/control_node.h"
#include "parley_nodelets/lidar_node.h"
#include "parley_nodelets/local_node.h"
#include "parley_nodelets/odometry_node.h"
#include "parley_nodelets/planner_node.h"
#include "parley_nodelets/team_node.h"
#include "parley_nodelets/topology_node.h"

namespace parley_nodelets {

/// A stage's node in a nodelet manager.
template <class Node>
class StageNodelet : public nodelet::Nodelet {
 private:
  void onInit() override {
    try {
      node_ = std::make_unique<Node>(getNodeHandle(), getPrivateNodeHandle(), getName());
    } catch (const std::exception& error) {
      NODELET_FATAL_STREAM(error.what());
      throw;  // the manager must know that this stage does not run
    }
  }

  std::unique_ptr<Node> node_;
};

class Odometry : public StageNodelet<parley::OdometryNode> {};
class Local : public StageNodelet<parley::LocalNode> {};
class Lidar : public StageNodelet<parley::LidarNode> {};
class Team : public StageNodelet<parley::TeamNode> {};
class Topology : public StageNodelet<parley::TopologyNode> {};
class Planner : public StageNodelet<parley::PlannerNode> {};
class Control : public StageNodelet<parley::ControlNode> {};

}  // namespace parley_nodelets

PLUGINLIB_EXPORT_CLASS(parley_nodelets::Odometry, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(parley_nodelets::Local, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(parley_nodelets::Lidar, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(parley_nodelets::Team, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(parley_nodelets::Topology, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(parley_nodelets::Planner, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(parley_nodelets::Control, nodelet::Nodelet)

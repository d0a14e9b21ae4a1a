// SPDX-License-Identifier: BSD-3-Clause
// A robot's nodelet manager: loads the stages that its arguments name ("robot local lidar topology planner control"), offers
// the services of a nodelet manager so that a driver can join, and unloads all of them before ROS ends.
#include <nodelet/loader.h>
#include <ros/console.h>
#include <ros/init.h>
#include <ros/names.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>

#include <cctype>
#include <string>
#include <vector>

#include "parley_nodelets/clean_exit.h"

namespace {

std::string className(std::string stage) {
  if (!stage.empty()) stage[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(stage[0])));
  return "parley_nodelets/" + stage;
}

/// Each stage becomes a nodelet beside this node, with a private namespace of its name.
bool loadStages(nodelet::Loader& loader, const std::vector<std::string>& stages) {
  for (const std::string& stage : stages) {
    if (!loader.load(ros::names::resolve(stage), className(stage), ros::names::getRemappings(), {})) {
      ROS_FATAL_STREAM("cannot start stage '" << stage << "'");
      return false;
    }
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  parley::CleanExit exit;
  std::vector<std::string> stages;
  ros::removeROSArgs(argc, argv, stages);
  stages.erase(stages.begin());
  ros::init(argc, argv, "robot", ros::init_options::NoSigintHandler);
  ros::NodeHandle nh;
  exit.answerShutdownRequests();
  if (stages.empty()) {
    ROS_FATAL("usage: robot STAGE...   (odometry local lidar topology planner control team)");
    return 2;
  }

  ros::AsyncSpinner spinner(1);
  spinner.start();
  nodelet::Loader loader(ros::NodeHandle("~"));
  bool loaded = false;
  try {
    loaded = loadStages(loader, stages);
    if (loaded) exit.wait();
  } catch (const std::exception& error) {
    ROS_FATAL_STREAM(error.what());
  }
  loader.clear();
  parley::CleanExit::shutdown();
  return loaded ? 0 : 1;
}

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/init.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>

#include <exception>
#include <memory>

#include "parley_nodelets/clean_exit.h"

namespace parley {

/// `main` of a stage's standalone node. Exit status 1 if its parameters are unusable.
template <class Node>
int runNode(int argc, char** argv, const char* name) {
  CleanExit exit;
  ros::init(argc, argv, name, ros::init_options::NoSigintHandler);
  ros::NodeHandle nh, pnh("~");
  exit.answerShutdownRequests();
  try {
    const auto node = std::make_unique<Node>(nh, pnh, name);
    ros::AsyncSpinner spinner(1);
    spinner.start();
    exit.wait();
  } catch (const std::exception& error) {
    ROS_FATAL_STREAM(error.what());
    return 1;
  }
  CleanExit::shutdown();
  return 0;
}

}  // namespace parley

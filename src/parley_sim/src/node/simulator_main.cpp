// SPDX-License-Identifier: BSD-3-Clause
#include <ros/console.h>
#include <ros/init.h>

#include <exception>

#include "parley_nodelets/parameters.h"
#include "simulator.h"

int main(int argc, char** argv) {
  ros::init(argc, argv, "simulator");
  ros::NodeHandle nh, pnh("~");
  try {
    parley::ParameterLoader loader(pnh);
    parley::sim::SimulatorOptions options;
    loader.load("", options);
    loader.finish();
    const parley::sim::Simulator simulator(nh, pnh, options);
    ros::spin();
  } catch (const std::exception& error) {
    ROS_FATAL_STREAM(error.what());
    return 1;
  }
  return 0;
}

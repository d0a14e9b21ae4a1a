// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "parley_geometry/footprint.h"
#include "parley_geometry/motion.h"
#include "parley_lidar/lidar_options.h"
#include "parley_nodelets/parameters.h"
#include "parley_robot/robot_options.h"

namespace parley {

/// Names of the robot's frames, in messages and tf. No default: under one master they carry the robot's prefix.
struct Frames {
  std::string odom;
  std::string local;
  std::string base;

  template <class Visitor>
  void visit(Visitor& v) {
    v.text("odom", odom, "odometry's frame, parent of the base frame; goals are given in it");
    v.text("local", local, "frame of all else, which stays smooth where odometry is corrected");
    v.text("base", base, "the robot's own frame");
  }
};

/// What every node of a robot has to know, whichever stage it runs.
struct NodeConfig {
  Frames frames;
  Footprint footprint;
  MotionLimits limits;
  LidarMount mount;
  WiringOptions wiring;
};

/// Loads the groups `frames`, `robot/footprint`, `robot/limits`, `robot/mount` (all keys required) and `wiring`.
NodeConfig loadNodeConfig(ParameterLoader& loader);

/// The same with the options of the node's stage, which are the plain values of its private namespace.
template <class Options>
struct StageConfig {
  NodeConfig node;
  Options stage;
};

/// Throws std::invalid_argument with all problems.
template <class Options>
StageConfig<Options> loadStageConfig(const ros::NodeHandle& pnh) {
  ParameterLoader loader(pnh);
  StageConfig<Options> config;
  config.node = loadNodeConfig(loader);
  loader.load("", config.stage);
  loader.finish();
  return config;
}

}  // namespace parley

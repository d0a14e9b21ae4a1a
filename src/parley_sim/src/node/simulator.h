// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>
#include <ros/wall_timer.h>
#include <std_srvs/Empty.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_broadcaster.h>

#include <memory>
#include <string>
#include <vector>

#include "parley_sim/fleet_runner.h"
#include "robot_port.h"

namespace parley::sim {

struct SimulatorOptions {
  std::string scenario;
  std::string world;
  std::string result;
  std::string world_frame = "world";
  double real_time_factor = 1.0;  // [-]
  int robots = 0;                 // [-]
  bool wait = true;

  template <class Visitor>
  void visit(Visitor& v) {
    v.text("scenario", scenario, "file of the scenario");
    v.text("world", world, "file of a map to use instead of the scenario's");
    v.text("result", result, "file for the result as JSON; empty: none");
    v.text("world_frame", world_frame, "frame of the ground truth, parent of all odom frames in tf; empty: no such transform");
    v.number("real_time_factor", real_time_factor, "-", 0.01, 100.0, "simulated seconds per second, if the machine can");
    v.integer("robots", robots, "-", 0, 1000, "only so many of the scenario's robots; 0: all");
    v.flag("wait", wait, "time stands until all robots' stages are up");
  }
};

/// The engine that fleet_run drives in lockstep, with robots that live behind topics: it owns /clock, gives each robot
/// its sensors and its goal, takes its commands, and judges the run. All in one thread, driven by a wall timer.
class Simulator {
 public:
  /// Throws InputError or std::invalid_argument.
  Simulator(const ros::NodeHandle& nh, const ros::NodeHandle& pnh, const SimulatorOptions& options);

  const SimulatorOptions& options() const { return options_; }

 private:
  bool onReset(std_srvs::EmptyRequest&, std_srvs::EmptyResponse&);
  void start();
  void onTimer();
  bool isReady();
  void step();
  void publishClock(double time);
  void publishTransforms(double time);
  void publishMounts();
  void finish();

  SimulatorOptions options_;
  Scenario scenario_;
  World world_;
  std::vector<std::unique_ptr<RobotPort>> ports_;
  std::unique_ptr<FleetRunner> runner_;
  bool ready_ = false;
  bool finished_ = false;
  ros::WallTime started_;

  ros::Publisher clock_;
  ros::Publisher result_;
  tf2_ros::TransformBroadcaster transforms_;
  tf2_ros::StaticTransformBroadcaster mounts_;
  ros::ServiceServer reset_;
  ros::WallTimer timer_;
};

}  // namespace parley::sim

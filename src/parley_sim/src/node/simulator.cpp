// SPDX-License-Identifier: BSD-3-Clause
#include "simulator.h"

#include <rosgraph_msgs/Clock.h>
#include <std_msgs/String.h>

#include <algorithm>
#include <fstream>

#include "parley_nodelets/sensor_conversions.h"
#include "parley_sim/input_error.h"
#include "parley_sim/result.h"
#include "parley_sim/scenario_loader.h"
#include "parley_sim/world_loader.h"

namespace parley::sim {
namespace {

/// A robot's mind that lives behind topics.
class RemoteBrain : public Brain {
 public:
  explicit RemoteBrain(RobotPort& port) : port_(port) {}

  BrainOutput step(const SensorReadings& readings) override {
    port_.publish(readings);
    BrainOutput output;
    output.twist = port_.command(readings.clock);
    output.state = port_.state();
    output.packets = port_.takeSent();
    return output;
  }

 private:
  RobotPort& port_;
};

Scenario scenarioFor(const SimulatorOptions& options) {
  if (options.scenario.empty()) throw InputError("scenario: is missing and has no default");
  Scenario scenario = loadScenario(options.scenario);
  if (!options.world.empty()) scenario.map = options.world;
  const auto count = static_cast<std::size_t>(options.robots);
  if (count > 0 && count < scenario.robots.size()) {
    scenario.robots.resize(count);
    const auto isOfNobody = [count](const Event& event) { return event.kind != EventKind::kDoor && event.robot >= count; };
    scenario.events.erase(std::remove_if(scenario.events.begin(), scenario.events.end(), isOfNobody), scenario.events.end());
  }
  // Under one master all nodes read one clock.
  for (RobotSpec& robot : scenario.robots) robot.clock = ClockSpec{};
  return scenario;
}

geometry_msgs::TransformStamped stamped(const Pose2& T_parent_child, double time, const std::string& parent,
                                        const std::string& child) {
  geometry_msgs::TransformStamped t;
  t.header.stamp = toRosTime(time);
  t.header.frame_id = parent;
  t.child_frame_id = child;
  t.transform.translation.x = T_parent_child.x;
  t.transform.translation.y = T_parent_child.y;
  t.transform.rotation = toQuaternion(T_parent_child.yaw);
  return t;
}

}  // namespace

Simulator::Simulator(const ros::NodeHandle& nh, const ros::NodeHandle& pnh, const SimulatorOptions& options)
    : options_(options), scenario_(scenarioFor(options)), world_(loadWorld(scenario_.map)) {
  checkStarts(scenario_, world_);
  ros::NodeHandle handle(nh), own(pnh);
  clock_ = handle.advertise<rosgraph_msgs::Clock>("/clock", 10);
  result_ = own.advertise<std_msgs::String>("result", 1, true);
  for (const RobotSpec& robot : scenario_.robots) ports_.push_back(std::make_unique<RobotPort>(nh, robot));
  start();
  reset_ = handle.advertiseService("reset", &Simulator::onReset, this);
  timer_ = handle.createWallTimer(ros::WallDuration(Simulation::kStepTime / options_.real_time_factor),
                                  [this](const ros::WallTimerEvent&) { onTimer(); });
}

void Simulator::start() {
  const auto factory = [this](const RobotSpec& spec, double) -> std::unique_ptr<Brain> {
    const auto port = std::find_if(ports_.begin(), ports_.end(), [&spec](const auto& p) { return p->name() == spec.name; });
    return std::make_unique<RemoteBrain>(**port);
  };
  runner_ = std::make_unique<FleetRunner>(scenario_, world_, factory);
  finished_ = false;
  started_ = ros::WallTime::now();
  publishMounts();
  for (const auto& port : ports_) {
    port->reset();
    port->publishGoal(Simulation::kStepTime);
  }
}

bool Simulator::onReset(std_srvs::EmptyRequest&, std_srvs::EmptyResponse&) {
  start();
  return true;
}

void Simulator::onTimer() {
  if (!ready_ && !isReady()) return;
  step();
}

bool Simulator::isReady() {
  std::string missing;
  for (const auto& port : ports_) {
    if (!port->isConnected()) missing += " " + port->name();
  }
  ready_ = !options_.wait || missing.empty();
  started_ = ros::WallTime::now();
  if (!ready_) ROS_INFO_STREAM_THROTTLE(10.0, "time stands until the stages are up of" << missing);
  return ready_;
}

void Simulator::step() {
  // The clock goes first: what the robots get now is stamped with this time.
  const double time = runner_->simulation().time() + Simulation::kStepTime;
  publishClock(time);
  runner_->step();
  publishTransforms(time);
  if (runner_->finished() && !finished_) finish();
}

void Simulator::publishClock(double time) {
  rosgraph_msgs::Clock clock;
  clock.clock = toRosTime(time);
  clock_.publish(clock);
}

void Simulator::publishTransforms(double time) {
  const Simulation& simulation = runner_->simulation();
  std::vector<geometry_msgs::TransformStamped> transforms;
  for (std::size_t i = 0; i < ports_.size(); ++i) {
    const Body& body = simulation.truth().bodies[i];
    if (!body.present || !runner_->readings()[i].odometry) continue;
    const RobotPort& port = *ports_[i];
    const Pose2 T_odom_base = runner_->readings()[i].odometry->pose;
    transforms.push_back(stamped(T_odom_base, time, port.frame("odom"), port.frame("base_link")));
    ports_[i]->publishTruth(body.state, time, options_.world_frame);
    if (options_.world_frame.empty()) continue;
    transforms.push_back(stamped(body.state.pose * T_odom_base.inverse(), time, options_.world_frame, port.frame("odom")));
  }
  if (!transforms.empty()) transforms_.sendTransform(transforms);
}

void Simulator::publishMounts() {
  std::vector<geometry_msgs::TransformStamped> mounts;
  for (std::size_t i = 0; i < ports_.size(); ++i) {
    const LidarSpec& lidar = scenario_.robots[i].lidar;
    mounts.push_back(stamped(lidar.pose, 0.0, ports_[i]->frame("base_link"), ports_[i]->frame("lidar")));
    mounts.back().transform.translation.z = lidar.height;
  }
  mounts_.sendTransform(mounts);
}

void Simulator::finish() {
  finished_ = true;
  const Result result = resultOf(*runner_, "full", (ros::WallTime::now() - started_).toSec());
  ROS_INFO_STREAM(summaryOf(result));
  std_msgs::String message;
  message.data = toJson(result);
  if (!options_.result.empty() && !(std::ofstream(options_.result) << message.data).flush()) {
    ROS_ERROR_STREAM("cannot write " << options_.result);
  }
  result_.publish(message);
}

}  // namespace parley::sim

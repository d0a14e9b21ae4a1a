// SPDX-License-Identifier: BSD-3-Clause
#include "parley_sim/stack_brain.h"

#include <algorithm>

#include "explanation.h"
#include "parley_robot/config.h"
#include "parley_robot/robot_stack.h"
#include "parley_sim/input_error.h"

namespace parley::sim {
namespace {

std::string joined(const std::vector<std::string>& problems) {
  std::string line;
  for (const std::string& problem : problems) line += (line.empty() ? "" : "; ") + problem;
  return line;
}

RobotOptions optionsFor(RobotOptions options, const RobotSpec& spec, double goal_tolerance) {
  options.name = spec.name;
  options.footprint = spec.footprint;
  options.limits = spec.limits;
  options.mount.x = spec.lidar.pose.x;
  options.mount.y = spec.lidar.pose.y;
  options.mount.z = spec.lidar.height;
  options.mount.yaw = wrapAngle(spec.lidar.pose.yaw);
  options.goal_tolerance = goal_tolerance;
  options.key = simulatedTeamKey(1);
  return options;
}

class StackBrain : public Brain {
 public:
  StackBrain(const RobotOptions& options, const Eigen::Vector2d& goal_odom) : stack_(options), footprint_(options.footprint) {
    stack_.setGoal(goal_odom);
  }

  BrainOutput step(const SensorReadings& readings) override {
    if (readings.odometry) stack_.addOdometry(*readings.odometry);
    if (readings.scan) stack_.addScan(*readings.scan);
    if (readings.cloud) stack_.addCloud(*readings.cloud);
    for (const Payload& bytes : readings.packets) stack_.addPacket({bytes});
    const RobotOutput robot = stack_.step(readings.clock);
    BrainOutput output;
    output.twist = robot.twist;
    output.state = robot.state;
    for (const Packet& packet : robot.packets) output.packets.push_back(packet.bytes);
    const StageTimes& times = robot.times;
    output.stage_seconds = {times.lidar,      times.map_fusion, times.topology, times.route, times.relative_localization,
                            times.local_plan, times.trajectory, times.control};
    output.replans = robot.replans;
    output.route_switches = robot.route_switches;
    output.escapes = robot.escapes;
    if (const auto& escape = stack_.lastPlan().escape; escape && !stack_.odometry().empty()) {
      output.escape = stack_.odometry().latest().pose.inverse() * *escape;
    }
    if (stack_.team()) report(*stack_.team(), output);
    state_ = std::string(toString(robot.state)) + (robot.reason.empty() ? "" : ": " + robot.reason);
    return output;
  }

  std::string explain(const std::string& picture) const override {
    if (!picture.empty() && !drawExplanation(stack_, footprint_, picture))
      throw InputError("--explain: " + picture + ": cannot be written");
    return "state      " + state_ + "\n" + explanationOf(stack_);
  }

 private:
  static void report(const TeamLink& team, BrainOutput& output) {
    for (const auto& [id, teammate] : team.teammates()) {
      if (teammate.estimate.state != PoseState::kConfirmed) continue;
      output.beliefs.push_back({teammate.name, teammate.estimate.T_odom_peerodom.pose});
    }
    const SectionBytes& sections = team.exchange().counters().sections_sent;
    const auto count = [](std::size_t bytes) { return static_cast<std::int64_t>(bytes); };
    output.sent = {count(sections.map), count(sections.keyframe + sections.observation), count(sections.trajectory),
                   count(sections.beacon), count(sections.conflict)};
  }

  RobotStack stack_;
  Footprint footprint_;
  std::string state_;
};

}  // namespace

const std::vector<std::string>& variantNames() {
  static const std::vector<std::string> kNames{"full", "no_sharing", "no_conflict_resolution", "reactive"};
  return kNames;
}

BrainFactory stackBrains(const std::string& config_directory, const std::string& variant) {
  const std::vector<std::string>& names = variantNames();
  const auto name = std::find(names.begin(), names.end(), variant);
  if (name == names.end()) throw InputError("--variant: " + variant + ": there is no such variant");
  RobotOptions options;
  options.variant = static_cast<Variant>(name - names.begin());
  if (!config_directory.empty()) {
    const std::vector<std::string> problems = loadConfig(config_directory, options);
    if (!problems.empty()) throw InputError("--config: " + joined(problems));
  }
  return [options](const RobotSpec& spec, double goal_tolerance) -> std::unique_ptr<Brain> {
    const RobotOptions own = optionsFor(options, spec, goal_tolerance);
    const std::vector<std::string> problems = checkRobot(own);
    if (!problems.empty()) throw InputError(spec.name + ": " + joined(problems));
    return std::make_unique<StackBrain>(own, spec.goalInOdom());
  };
}

}  // namespace parley::sim

// SPDX-License-Identifier: BSD-3-Clause
#include "parley_sim/scenario_loader.h"

#include <cmath>
#include <filesystem>
#include <set>

#include "event_loader.h"
#include "parley_sim/input_error.h"
#include "yaml_section.h"

namespace parley::sim {
namespace {

constexpr Range kCoordinate{-1e5, 1e5};

Footprint readFootprint(YamlSection section, Footprint footprint) {
  footprint.length = section.number("length", footprint.length, {0.05, 5.0});
  footprint.width = section.number("width", footprint.width, {0.05, 5.0});
  section.finish();
  return footprint;
}

MotionLimits readLimits(YamlSection section, MotionLimits limits) {
  limits.speed = section.number("speed", limits.speed, {0.05, 10.0});
  limits.turn_rate = section.number("turn_rate", limits.turn_rate, {0.05, 10.0});
  limits.acceleration = section.number("acceleration", limits.acceleration, {0.05, 20.0});
  limits.turn_acceleration = section.number("turn_acceleration", limits.turn_acceleration, {0.05, 50.0});
  section.finish();
  return limits;
}

LidarSpec readLidar(YamlSection section, LidarSpec lidar) {
  lidar.range = section.number("range", lidar.range, {0.2, 200.0});
  const double beams = section.number("beams", lidar.beams, {8.0, 20000.0});
  if (beams != std::floor(beams)) section.fail("beams", "must be a whole number");
  lidar.beams = static_cast<int>(beams);
  lidar.rate = section.number("rate", lidar.rate, {0.1, 50.0});
  lidar.noise = section.number("noise", lidar.noise, {0.0, 1.0});
  const std::size_t mode = section.choice("mode", static_cast<std::size_t>(lidar.mode), {"planar", "spatial"});
  lidar.mode = static_cast<LidarMode>(mode);
  const std::vector<double> pose = section.numbers("pose", {lidar.pose.x, lidar.pose.y, lidar.height, lidar.pose.yaw},
                                                   {{-5.0, 5.0}, {-5.0, 5.0}, {0.0, 2.4}, {-10.0, 10.0}});
  lidar.pose = {pose[0], pose[1], pose[3]};
  lidar.height = pose[2];
  section.finish();
  return lidar;
}

OdometrySpec readOdometry(YamlSection section, OdometrySpec odometry) {
  odometry.rate = section.number("rate", odometry.rate, {1.0, 50.0});
  odometry.translation_noise = section.number("translation_noise", odometry.translation_noise, {0.0, 10.0});
  odometry.rotation_noise = section.number("rotation_noise", odometry.rotation_noise, {0.0, 10.0});
  section.finish();
  return odometry;
}

ClockSpec readClock(YamlSection section, ClockSpec clock) {
  clock.offset = section.number("offset", clock.offset, {-1e9, 1e9});
  clock.drift = section.number("drift", clock.drift, {-0.1, 0.1});
  section.finish();
  return clock;
}

RadioSpec readRadio(YamlSection section, RadioSpec radio) {
  radio.range = section.number("range", radio.range, {0.0, 1e5});
  radio.success_rate = section.number("success_rate", radio.success_rate, {0.0, 1.0});
  radio.latency = section.number("latency", radio.latency, {0.0, 60.0});
  radio.jitter = section.number("jitter", radio.jitter, {0.0, 60.0});
  radio.bandwidth = section.number("bandwidth", radio.bandwidth, {0.0, 1e10});
  radio.line_of_sight = section.flag("line_of_sight", radio.line_of_sight);
  section.finish();
  return radio;
}

/// What may stand at the top for all robots and in a robot's entry for it alone.
RobotSpec readEquipment(YamlSection& section, RobotSpec robot) {
  robot.footprint = readFootprint(section.section("footprint"), robot.footprint);
  robot.limits = readLimits(section.section("limits"), robot.limits);
  robot.lidar = readLidar(section.section("lidar"), robot.lidar);
  robot.odometry = readOdometry(section.section("odometry"), robot.odometry);
  robot.clock = readClock(section.section("clock"), robot.clock);
  robot.radio = readRadio(section.section("radio"), robot.radio);
  return robot;
}

RobotSpec readRobot(YamlSection section, const RobotSpec& common) {
  for (const char* key : {"name", "start", "goal"}) section.require(key);
  RobotSpec robot = readEquipment(section, common);
  robot.name = section.text("name", "");
  const std::string letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
  if (robot.name.empty() || robot.name.size() > 64 || robot.name.find_first_not_of(letters) != std::string::npos) {
    section.fail("name", "is '" + robot.name + "', must be 1 to 64 letters, digits, '_' and '-'");
  }
  const std::vector<double> start = section.numbers("start", {}, {kCoordinate, kCoordinate, {-100.0, 100.0}});
  const std::vector<double> goal = section.numbers("goal", {}, {kCoordinate, kCoordinate});
  robot.start = {start[0], start[1], wrapAngle(start[2])};
  robot.goal = {goal[0], goal[1]};
  section.finish();
  return robot;
}

std::vector<RobotSpec> readRobots(YamlSection& section, const RobotSpec& common) {
  section.require("robots");
  std::vector<RobotSpec> robots;
  std::set<std::string> names;
  for (const YamlSection& entry : section.sections("robots")) {
    robots.push_back(readRobot(entry, common));
    if (!names.insert(robots.back().name).second) entry.fail("name", "'" + robots.back().name + "' is there twice");
  }
  if (robots.empty()) section.fail("robots", "must be a list of at least one robot");
  return robots;
}

MovingObstacleSpec readObstacle(YamlSection section) {
  MovingObstacleSpec obstacle;
  obstacle.radius = section.number("radius", obstacle.radius, {0.01, 10.0});
  obstacle.speed = section.number("speed", obstacle.speed, {0.0, 20.0});
  obstacle.path = section.points("path", 1);
  section.finish();
  return obstacle;
}

/// The map's path, relative to the scenario's file.
std::string mapPath(YamlSection& section, const std::string& file) {
  section.require("map");
  const std::filesystem::path map = section.text("map", "");
  const std::filesystem::path path = map.is_absolute() ? map : std::filesystem::path(file).parent_path() / map;
  if (!std::filesystem::is_regular_file(path)) section.fail("map", "no such file: " + path.string());
  return path.lexically_normal().string();
}

}  // namespace

Scenario loadScenario(const std::string& file, const std::vector<Override>& overrides) {
  YAML::Node tree = loadYaml(file);
  for (const auto& [path, value] : overrides) tree.reset(withOverride(tree, path, value));
  YamlSection section(tree, file, "");
  Scenario scenario;
  scenario.name = std::filesystem::path(file).stem().string();
  scenario.file = file;
  scenario.map = mapPath(section, file);
  section.require("duration");
  scenario.duration = section.number("duration", 0.0, {0.1, 1e6});
  const double seed = section.number("seed", 1.0, {0.0, 9007199254740992.0});
  if (seed != std::floor(seed)) section.fail("seed", "must be a whole number");
  scenario.seed = static_cast<std::uint64_t>(seed);
  scenario.goal_tolerance = section.number("goal_tolerance", scenario.goal_tolerance, {0.01, 10.0});
  scenario.judge = static_cast<Judge>(section.choice("judge", 0, {"truth", "odometry"}));
  scenario.robots = readRobots(section, readEquipment(section, {}));
  scenario.events = readEvents(section.sections("events"), scenario.robots);
  for (const Event& event : scenario.events) {
    if (event.kind == EventKind::kJoin) scenario.robots[event.robot].joins_later = true;
  }
  for (const YamlSection& entry : section.sections("obstacles")) scenario.obstacles.push_back(readObstacle(entry));
  section.finish();
  return scenario;
}

}  // namespace parley::sim

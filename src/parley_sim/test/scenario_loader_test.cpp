// SPDX-License-Identifier: BSD-3-Clause
#include "parley_sim/scenario_loader.h"

#include <gtest/gtest.h>

#include "parley_sim/input_error.h"
#include "worlds.h"

namespace parley::sim {
namespace {

class ScenarioLoaderTest : public testing::Test {
 protected:
  ScenarioLoaderTest() : world_(emptyWorld(10, 10)) { directory_.writeWorld("room", world_); }

  std::string write(const std::string& text) { return directory_.write("s.yaml", text); }
  static std::string robots(const std::string& rest = "") {
    return "map: room.yaml\nduration: 60\nrobots:\n  - {name: a, start: [1, 1, 0], goal: [8, 8]}\n"
           "  - {name: b, start: [3, 1, 1.5], goal: [8, 1]}\n" +
           rest;
  }
  /// What is said of a file, without the folder.
  std::string messageOf(const std::string& text, const std::vector<Override>& overrides = {}) {
    try {
      const Scenario scenario = loadScenario(write(text), overrides);
      checkStarts(scenario, world_);
    } catch (const InputError& error) {
      std::string message = error.what();
      const std::size_t at = message.find("s.yaml");
      return at == std::string::npos ? message : message.substr(at);
    }
    return "";
  }

  TemporaryDirectory directory_;
  World world_;
};

TEST_F(ScenarioLoaderTest, missingKeysHaveTheDocumentedDefaults) {
  const Scenario s = loadScenario(write(robots()));
  EXPECT_EQ(s.name, "s");
  EXPECT_EQ(s.map, directory_.file("room.yaml"));
  EXPECT_EQ(s.duration, 60.0);
  EXPECT_EQ(s.seed, 1u);
  EXPECT_EQ(s.goal_tolerance, 0.3);
  EXPECT_EQ(s.judge, Judge::kTruth);
  ASSERT_EQ(s.robots.size(), 2u);
  const RobotSpec& r = s.robots[1];
  EXPECT_EQ(r.name, "b");
  EXPECT_EQ(r.start.yaw, 1.5);
  EXPECT_EQ(r.footprint.length, 0.8);
  EXPECT_EQ(r.footprint.width, 0.4);
  EXPECT_EQ(r.limits.speed, 2.0);
  EXPECT_EQ(r.limits.turn_rate, 1.5708);
  EXPECT_EQ(r.limits.acceleration, 2.0);
  EXPECT_EQ(r.limits.turn_acceleration, 4.0);
  EXPECT_EQ(r.lidar.range, 4.0);
  EXPECT_EQ(r.lidar.beams, 720);
  EXPECT_EQ(r.lidar.rate, 10.0);
  EXPECT_EQ(r.lidar.noise, 0.02);
  EXPECT_EQ(r.lidar.mode, LidarMode::kPlanar);
  EXPECT_EQ(r.lidar.height, 0.5);
  EXPECT_EQ(r.odometry.rate, 50.0);
  EXPECT_EQ(r.odometry.translation_noise, 0.003);
  EXPECT_EQ(r.odometry.rotation_noise, 0.0002);
  EXPECT_EQ(r.clock.offset, 0.0);
  EXPECT_EQ(r.radio.range, 10.0);
  EXPECT_EQ(r.radio.success_rate, 1.0);
  EXPECT_EQ(r.radio.latency, 0.02);
  EXPECT_EQ(r.radio.jitter, 0.01);
  EXPECT_EQ(r.radio.bandwidth, 65536.0);
  EXPECT_FALSE(r.radio.line_of_sight);
}

TEST_F(ScenarioLoaderTest, aRobotsOwnEntryWinsKeyByKey) {
  const Scenario s = loadScenario(write(
      "map: room.yaml\nduration: 60\nseed: 7\njudge: odometry\nlimits: {speed: 1.5}\nlidar: {range: 9}\nrobots:\n"
      "  - {name: a, start: [1, 1, 0], goal: [8, 8], limits: {acceleration: 1}, lidar: {mode: spatial, pose: [0.1, 0, 0.7, 3]}}\n"
      "  - {name: b, start: [3, 1, 0], goal: [8, 8], clock: {offset: -3, drift: 0.0001}}\n"));
  EXPECT_EQ(s.seed, 7u);
  EXPECT_EQ(s.judge, Judge::kOdometry);
  EXPECT_EQ(s.robots[0].limits.speed, 1.5);
  EXPECT_EQ(s.robots[0].limits.acceleration, 1.0);
  EXPECT_EQ(s.robots[1].limits.acceleration, 2.0);
  EXPECT_EQ(s.robots[0].lidar.range, 9.0);
  EXPECT_EQ(s.robots[0].lidar.mode, LidarMode::kSpatial);
  EXPECT_EQ(s.robots[0].lidar.height, 0.7);
  EXPECT_EQ(s.robots[0].lidar.pose.yaw, 3.0);
  EXPECT_NEAR(s.robots[1].clock.at(10.0), 7.001, 1e-12);
}

TEST_F(ScenarioLoaderTest, readsEventsByTimeAndObstacles) {
  const Scenario s = loadScenario(write(
      robots("events:\n  - {time: 20, kill: a}\n  - {time: 10, join: b}\n  - {time: 15, door: [[4, 4], [4, 6]], state: closed}\n"
             "  - {time: 5, stall: b, for: 10}\n  - {time: 6, mute: b, for: 1}\n  - {time: 7, blind: a, for: 2}\n"
             "obstacles:\n  - {path: [[1, 2], [3, 4]]}\n")));
  ASSERT_EQ(s.events.size(), 6u);
  EXPECT_EQ(s.events[0].kind, EventKind::kStall);
  EXPECT_EQ(s.events[0].robot, 1u);
  EXPECT_EQ(s.events[0].duration, 10.0);
  EXPECT_EQ(s.events[3].kind, EventKind::kJoin);
  EXPECT_EQ(s.events[4].kind, EventKind::kDoor);
  EXPECT_TRUE(s.events[4].closed);
  EXPECT_EQ(s.events[4].to, Eigen::Vector2d(4, 6));
  EXPECT_EQ(s.events[5].kind, EventKind::kKill);
  EXPECT_TRUE(s.robots[1].joins_later);
  EXPECT_FALSE(s.robots[0].joins_later);
  ASSERT_EQ(s.obstacles.size(), 1u);
  EXPECT_EQ(s.obstacles[0].radius, 0.3);
  EXPECT_EQ(s.obstacles[0].speed, 1.0);
}

TEST_F(ScenarioLoaderTest, overridesReachEveryKeyInTheirOrder) {
  const Scenario s = loadScenario(write(robots()), {{"radio.success_rate", "0.2"},
                                                    {"robots.0.start", "[1, 2, 0]"},
                                                    {"robots.1.limits.speed", "1"},
                                                    {"seed", "3"},
                                                    {"seed", "4"},
                                                    {"events", "[{time: 1, kill: a}]"}});
  EXPECT_EQ(s.robots[1].radio.success_rate, 0.2);
  EXPECT_EQ(s.robots[0].start.y, 2.0);
  EXPECT_EQ(s.robots[1].limits.speed, 1.0);
  EXPECT_EQ(s.robots[0].limits.speed, 2.0);
  EXPECT_EQ(s.seed, 4u);
  EXPECT_EQ(s.events.size(), 1u);
}

TEST_F(ScenarioLoaderTest, everythingWrongIsOneLineWithFileKeyAndReason) {
  const auto with = [](const std::string& rest) { return robots(rest); };
  const std::vector<std::pair<std::string, std::string>> cases{
      {with("wheels: 4\n"), "s.yaml: wheels: unknown key"},
      {with("lidar: {reach: 4}\n"), "s.yaml: lidar.reach: unknown key"},
      {with("lidar: {range: far}\n"), "s.yaml: lidar.range: must be a number"},
      {with("lidar: {range: '4'}\n"), "s.yaml: lidar.range: must be a number"},
      {with("lidar: {range: .nan}\n"), "s.yaml: lidar.range: is nan, must be between 0.2 and 200"},
      {with("lidar: {beams: 10.5}\n"), "s.yaml: lidar.beams: must be a whole number"},
      {with("lidar: {mode: round}\n"), "s.yaml: lidar.mode: is 'round', must be planar or spatial"},
      {with("lidar: {pose: [0, 0, 0]}\n"), "s.yaml: lidar.pose: must be a list of 4 numbers"},
      {with("lidar: 4\n"), "s.yaml: lidar: must be a map"},
      {with("limits: {speed: -1}\n"), "s.yaml: limits.speed: is -1, must be between 0.05 and 10"},
      {with("radio: {success_rate: 1.5}\n"), "s.yaml: radio.success_rate: is 1.5, must be between 0 and 1"},
      {with("radio: {line_of_sight: 3}\n"), "s.yaml: radio.line_of_sight: must be true or false"},
      {with("judge: me\n"), "s.yaml: judge: is 'me', must be truth or odometry"},
      {with("seed: 1.5\n"), "s.yaml: seed: must be a whole number"},
      {with("seed: 1\nseed: 2\n"), "s.yaml: seed: is there twice"},
      {with("events: [{time: 1, kill: c}]\n"), "s.yaml: events.0.kill: there is no robot 'c'"},
      {with("events: [{time: 1, stall: a}]\n"), "s.yaml: events.0.for: is missing"},
      {with("events: [{time: 1}]\n"), "s.yaml: events.0.kill: is missing"},
      {with("events: [{kill: a}]\n"), "s.yaml: events.0.time: is missing"},
      {with("events: [{time: 1, kill: a, mute: b, for: 1}]\n"), "s.yaml: events.0.mute: stands beside 'kill'"},
      {with("events: [{time: 1, kill: a, for: 3}]\n"), "s.yaml: events.0.for: unknown key"},
      {with("events: [{time: 1, door: [[1, 2]], state: open}]\n"), "s.yaml: events.0.door: must be a list of at least 2"},
      {with("events: [{time: 1, door: [[1, 2], [1, 2]], state: open}]\n"), "s.yaml: events.0.door: must be two different"},
      {with("events: [{time: 1, door: [[1, 2], 3], state: open}]\n"), "s.yaml: events.0.door.1: must be a point"},
      {with("events: [{time: 1, door: [[1, 2], [3, 4]], state: ajar}]\n"), "s.yaml: events.0.state: is 'ajar'"},
      {with("events: [{time: 1, join: a}, {time: 2, join: a}]\n"), "s.yaml: events.1.join: this robot joins twice"},
      {with("events: {time: 1}\n"), "s.yaml: events: must be a list"},
      {with("obstacles: [{radius: 1}]\n"), "s.yaml: obstacles.0.path: is missing"},
      {"map: room.yaml\nduration: 60\n", "s.yaml: robots: is missing"},
      {"map: room.yaml\nduration: 60\nrobots: []\n", "s.yaml: robots: must be a list of at least one"},
      {"map: room.yaml\nrobots: [{name: a, start: [1, 1, 0], goal: [8, 8]}]\n", "s.yaml: duration: is missing"},
      {"duration: 60\n", "s.yaml: map: is missing"},
      {"map: hall.yaml\nduration: 60\n", "s.yaml: map: no such file: "},
      {"map: room.yaml\nduration: 60\nrobots: [{name: a, start: [1, 1], goal: [8, 8]}]\n",
       "s.yaml: robots.0.start: must be a list of 3"},
      {"map: room.yaml\nduration: 60\nrobots: [{name: a, start: [1, x, 0], goal: [8, 8]}]\n",
       "s.yaml: robots.0.start.1: must be a number"},
      {"map: room.yaml\nduration: 60\nrobots: [{name: a, start: [1, 1, 0]}]\n", "s.yaml: robots.0.goal: is missing"},
      {"map: room.yaml\nduration: 60\nrobots: [{name: a b, start: [1, 1, 0], goal: [8, 8]}]\n",
       "s.yaml: robots.0.name: is 'a b'"},
      {"map: room.yaml\nduration: 60\nrobots: [{name: [a], start: [1, 1, 0], goal: [8, 8]}]\n",
       "s.yaml: robots.0.name: must be a text"},
      {"map: room.yaml\nduration: 60\nrobots: [3]\n", "s.yaml: robots.0: must be a map"},
      {"- 1\n", "s.yaml: the file: must be a map"},
      {"map: [\n", "s.yaml: the file: is not YAML"},
      {"", "s.yaml: the file: cannot be read or is empty"},
  };
  for (const auto& [text, expected] : cases) {
    const std::string message = messageOf(text);
    EXPECT_EQ(message.find(expected), 0u) << "of\n" << text << "\nit says: " << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST_F(ScenarioLoaderTest, startsHaveToBeFree) {
  const auto starting = [](const std::string& start, const std::string& rest = "") {
    return "map: room.yaml\nduration: 60\nrobots:\n  - {name: a, start: [3, 3, 0], goal: [8, 8]}\n  - {name: b, start: " + start +
           ", goal: [8, 8]}\n" + rest;
  };
  EXPECT_EQ(messageOf(starting("[5, 3, 0]")), "");
  EXPECT_EQ(messageOf(starting("[50, 3, 0]")), "s.yaml: robots.1.start: b starts off the map");
  EXPECT_EQ(messageOf(starting("[0.3, 3, 0]")), "s.yaml: robots.1.start: b starts in a wall");
  EXPECT_EQ(messageOf(starting("[3.7, 3, 0]")), "s.yaml: robots.1.start: b starts in a");
  EXPECT_EQ(messageOf(starting("[3.7, 3, 0]", "events: [{time: 9, join: b}]\n")), "");
  EXPECT_EQ(messageOf(starting("[0.3, 3, 0]", "events: [{time: 9, join: b}]\n")), "s.yaml: robots.1.start: b starts in a wall");
  EXPECT_EQ(messageOf("map: room.yaml\nduration: 9\nrobots:\n  - {name: a, start: [3, 3, 0], goal: [8, 8]}\n"
                      "  - {name: a, start: [5, 3, 0], goal: [8, 8]}\n"),
            "s.yaml: robots.1.name: 'a' is there twice");
}

TEST_F(ScenarioLoaderTest, overridesThatReachNothingSaySo) {
  EXPECT_EQ(messageOf(robots(), {{"lidar.reach", "1"}}), "s.yaml: lidar.reach: unknown key");
  EXPECT_EQ(messageOf(robots(), {{"robots.2.start", "[1, 1, 0]"}}), "--set: robots.2.start: the list has no item '2', it has 2");
  EXPECT_EQ(messageOf(robots(), {{"robots.x", "1"}}), "--set: robots.x: the list has no item 'x', it has 2");
  EXPECT_EQ(messageOf(robots(), {{"duration.x", "1"}}), "--set: duration.x: there is no list or map that has 'x'");
  EXPECT_EQ(messageOf(robots(), {{"radio..x", "1"}}), "--set: radio..x: is not a key's path");
  EXPECT_EQ(messageOf(robots(), {{"radio.range", "["}}).find("--set: radio.range: value is not YAML"), 0u);
  EXPECT_EQ(messageOf(robots(), {{"radio.range", "far"}}), "s.yaml: radio.range: must be a number");
}

}  // namespace
}  // namespace parley::sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

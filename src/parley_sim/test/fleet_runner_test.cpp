// SPDX-License-Identifier: BSD-3-Clause
#include "parley_sim/fleet_runner.h"

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <set>
#include <sstream>

#include "parley_sim/input_error.h"
#include "parley_sim/picture.h"
#include "parley_sim/progress.h"
#include "parley_sim/result.h"
#include "parley_sim/trace.h"
#include "worlds.h"

namespace parley::sim {
namespace {

/// Turns to its goal and drives there; says something now and then.
class StraightBrain : public Brain {
 public:
  explicit StraightBrain(const Eigen::Vector2d& goal) : goal_(goal) {}

  BrainOutput step(const SensorReadings& readings) override {
    if (readings.odometry) pose_ = readings.odometry->pose;
    BrainOutput output;
    output.stage_seconds[7] = 0.001;
    if (++steps_ % 10 == 0) output.packets.push_back(Payload(72));
    output.replans = steps_;
    const Eigen::Vector2d to = pose_.inverse() * goal_;
    if (to.norm() < 0.1) {
      output.state = DriveState::kArrived;
      return output;
    }
    output.state = DriveState::kDriving;
    const double bearing = std::atan2(to.y(), to.x());
    output.twist = {std::abs(bearing) < 0.3 ? to.norm() : 0.0, 2.0 * bearing};
    return output;
  }

 private:
  Eigen::Vector2d goal_;
  Pose2 pose_;
  int steps_ = 0;
};

BrainFactory straight() {
  return [](const RobotSpec& spec, double) { return std::make_unique<StraightBrain>(spec.goalInOdom()); };
}

Scenario crossing() {
  Scenario scenario;
  scenario.name = "crossing";
  scenario.duration = 60.0;
  scenario.robots = {robotAt("a", {2, 2, 0.5}, {8, 2}), robotAt("b", {2, 5, -2.0}, {8, 8}), robotAt("c", {5, 9, 0}, {5, 9})};
  return scenario;
}

Result run(const Scenario& scenario, const World& world) {
  FleetRunner runner(scenario, world, straight());
  while (!runner.finished()) runner.step();
  return resultOf(runner, "full", 1.0);
}

TEST(FleetRunnerTest, drivesAllToTheirGoals) {
  const World world = emptyWorld(10, 10);
  const Result result = run(crossing(), world);
  EXPECT_TRUE(result.success);
  EXPECT_EQ(result.reachedCount(), 3);
  EXPECT_EQ(result.collisions(), 0);
  const RobotResult& a = result.robots[0];
  EXPECT_NEAR(a.straight, 6.0, 1e-9);
  EXPECT_NEAR(*a.shortest, 6.0, 1e-9);
  EXPECT_GE(a.length, 5.7);
  EXPECT_LT(a.length, 6.3);
  EXPECT_NEAR(*a.mean_speed, a.length / *a.time, 1e-12);
  EXPECT_NEAR(*a.min_clearance, 1.6, 0.3);
  EXPECT_EQ(a.final_state, "arrived");
  EXPECT_GT(a.tx_bytes, 0);
  EXPECT_GT(a.rx_bytes, a.tx_bytes);
  EXPECT_EQ(*result.delivered, 1.0);
  EXPECT_NEAR(*result.timing[7].p50, 1.0, 1e-3);
  EXPECT_FALSE(result.timing[0].p50.has_value());
  EXPECT_NE(summaryOf(result).find("crossing, seed 1, full: success, 3 of 3 reached, 0 collisions"), std::string::npos);
}

TEST(FleetRunnerTest, latecomersAndTheDeadAreCountedRight) {
  const World world = emptyWorld(10, 10);
  Scenario scenario = crossing();
  scenario.robots[1].joins_later = true;
  Event join;
  join.kind = EventKind::kJoin;
  join.time = 5.0;
  join.robot = 1;
  Event kill;
  kill.time = 1.0;
  scenario.events = {kill, join};
  const Result result = run(scenario, world);
  EXPECT_TRUE(result.success);
  EXPECT_FALSE(result.robots[0].reached);
  EXPECT_FALSE(result.robots[0].time.has_value());
  EXPECT_EQ(result.robots[0].final_state, "dead");
  EXPECT_TRUE(result.robots[1].reached);
  EXPECT_NEAR(*result.robots[1].time + 5.0, result.simulated, 0.05);
}

TEST(FleetRunnerTest, brainsThatCannotBeMadeAreSaidBeforeTheRun) {
  const World world = emptyWorld(10, 10);
  const BrainFactory broken = [](const RobotSpec&, double) -> std::unique_ptr<Brain> { throw InputError("no"); };
  EXPECT_THROW(FleetRunner(crossing(), world, broken), InputError);
}

std::set<std::string> keysOf(const YAML::Node& node) {
  std::set<std::string> keys;
  for (const auto& entry : node) keys.insert(entry.first.as<std::string>());
  return keys;
}

TEST(ResultTest, theFileHasAllKeysAndNullsWhereThereIsNoValue) {
  const World world = drawnWorld(10, 10, 0.05, [](double x, double) { return std::abs(x - 9.0) < 0.1; });
  Scenario scenario = crossing();
  scenario.duration = 5.0;
  scenario.robots[0].goal = {9.5, 2.0};
  const Result result = run(scenario, world);
  const YAML::Node json = YAML::Load(toJson(result));
  EXPECT_EQ(keysOf(json), std::set<std::string>({"scenario", "seed", "variant", "success", "collisions", "touched", "incidents",
                                                 "mean_time", "mean_length", "path_optimality", "mean_regret", "robots", "radio",
                                                 "relative_localization", "timing_ms", "simulated", "wall"}));
  EXPECT_EQ(keysOf(json["collisions"]), std::set<std::string>({"static", "robot", "moving"}));
  EXPECT_EQ(keysOf(json["robots"][0]),
            std::set<std::string>({"name", "reached", "time", "length", "straight", "shortest", "mean_speed", "min_clearance",
                                   "stopped", "escapes", "replans", "route_switches", "final_state", "tx_bytes", "rx_bytes"}));
  EXPECT_EQ(keysOf(json["radio"]),
            std::set<std::string>({"bytes_per_second_per_robot", "map_bytes", "keyframe_bytes", "trajectory_bytes",
                                   "beacon_bytes", "conflict_bytes", "overhead_bytes", "delivered"}));
  EXPECT_EQ(keysOf(json["relative_localization"]), std::set<std::string>({"encounters", "localized", "false", "translation_error",
                                                                          "rotation_error", "seconds_to_localize"}));
  EXPECT_EQ(keysOf(json["timing_ms"]), std::set<std::string>(kStageNames.begin(), kStageNames.end()));
  EXPECT_EQ(keysOf(json["timing_ms"]["lidar"]), std::set<std::string>({"p50", "p99"}));
  EXPECT_FALSE(json["success"].as<bool>());
  EXPECT_TRUE(json["robots"][0]["time"].IsNull());
  EXPECT_TRUE(json["robots"][0]["shortest"].IsNull());
  EXPECT_TRUE(json["robots"][0]["mean_speed"].IsNull());
  EXPECT_TRUE(json["relative_localization"]["translation_error"]["p50"].IsNull());
  EXPECT_TRUE(json["timing_ms"]["lidar"]["p50"].IsNull());
  EXPECT_EQ(json["robots"][2]["time"].as<double>(), 0.5);
  EXPECT_EQ(json["simulated"].as<double>(), 5.0);
}

TEST(ResultTest, textsAreEscapedAndSilenceIsZeroBytes) {
  Result result;
  result.scenario = "a \"b\"\\\n";
  const std::string json = toJson(result);
  EXPECT_NE(json.find("\"scenario\": \"a \\\"b\\\"\\\\\\u000a\""), std::string::npos);
  EXPECT_EQ(YAML::Load(json)["radio"]["map_bytes"].as<int>(), 0);
  EXPECT_TRUE(YAML::Load(json)["radio"]["delivered"].IsNull());
}

TEST(ResultTest, sameRunSameTextAndAnotherSeedAnother) {
  const World world = emptyWorld(10, 10);
  Scenario scenario = crossing();
  const std::string first = toJson(run(scenario, world));
  EXPECT_EQ(first, toJson(run(scenario, world)));
  scenario.seed = 2;
  EXPECT_NE(first, toJson(run(scenario, world)));
}

TEST(TraceTest, tenRowsASecondForEveryRobot) {
  const World world = emptyWorld(10, 10);
  TemporaryDirectory directory;
  {
    FleetRunner runner(crossing(), world, straight());
    Trace trace(directory.file("t.csv"));
    trace.note(runner);
    for (int i = 0; i < 50; ++i) {
      runner.step();
      trace.note(runner);
    }
  }
  std::istringstream lines(contentsOf(directory.file("t.csv")));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "time,robot,x,y,yaw,speed,turn_rate,state");
  std::getline(lines, line);
  EXPECT_EQ(line, "0.00,a,2.0000,2.0000,0.50000,0.0000,0.0000,stopped");
  int rows = 1;
  std::string last;
  for (; std::getline(lines, line); ++rows) last = line;
  EXPECT_EQ(rows, 3 * 11);
  EXPECT_EQ(last.rfind("1.00,c,5.0000,9.0000", 0), 0u);
  EXPECT_THROW(Trace("/no/such/folder/t.csv"), InputError);
}

TEST(PictureTest, showsEveryRobotsTrackOnTheMap) {
  const World world = drawnWorld(10, 10, 0.05, [](double x, double y) { return x > 4 && x < 5 && y < 1; });
  Scenario scenario = crossing();
  scenario.obstacles = {{0.3, 1.0, {{9, 1}, {9, 9}}}};
  Event door;
  door.kind = EventKind::kDoor;
  door.from = {1, 9};
  door.to = {2, 9};
  door.closed = true;
  scenario.events = {door};
  scenario.duration = 10.0;
  TemporaryDirectory directory;
  FleetRunner runner(scenario, world, straight());
  Picture picture;
  while (!runner.finished()) {
    runner.step();
    picture.note(runner);
  }
  picture.write(directory.file("p.png"), runner);
  const cv::Mat image = cv::imread(directory.file("p.png"));
  ASSERT_FALSE(image.empty());
  EXPECT_GT(image.cols, 1000);
  EXPECT_LT(image.cols, 1600);
  int colored = 0;
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      const cv::Vec3b c = image.at<cv::Vec3b>(y, x);
      colored += std::max({c[0], c[1], c[2]}) - std::min({c[0], c[1], c[2]}) > 80 ? 1 : 0;
    }
  }
  EXPECT_GT(colored, 2000);
  EXPECT_THROW(picture.write("/no/such/folder/p.png", runner), InputError);
}

TEST(ProgressTest, aLineEveryFiveSecondsOrOneThatIsWrittenOver) {
  const World world = emptyWorld(10, 10);
  for (const bool terminal : {false, true}) {
    std::ostringstream stream;
    Scenario scenario = crossing();
    scenario.robots[0].goal = {100, 100};
    scenario.duration = 12.0;
    FleetRunner runner(scenario, world, straight());
    Progress progress(stream, terminal);
    while (!runner.finished()) {
      runner.step();
      progress.note(runner);
    }
    progress.finish();
    const std::string text = stream.str();
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), terminal ? 1 : 3);
    EXPECT_EQ(text.find('\r') != std::string::npos, terminal);
    EXPECT_NE(text.find("10.0 of 12 s, 2 of 3 reached, "), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace parley::sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

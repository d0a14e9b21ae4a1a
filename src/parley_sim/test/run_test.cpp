// SPDX-License-Identifier: BSD-3-Clause
#include "parley_sim/run.h"

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include "parley_sim/input_error.h"
#include "worlds.h"

namespace parley::sim {
namespace {

class RunTest : public testing::Test {
 protected:
  RunTest() {
    directory_.writeWorld("room", emptyWorld(10, 6));
    directory_.write("s.yaml",
                     "map: room.yaml\nduration: 20\nrobots:\n  - {name: a, start: [2, 3, 0], goal: [7, 3]}\n"
                     "  - {name: b, start: [2, 5, 0], goal: [7, 5], lidar: {mode: spatial}}\n");
  }
  Arguments arguments(std::vector<std::string> words) const {
    words.insert(words.begin(), {directory_.file("s.yaml"), "--quiet"});
    return parseArguments(words);
  }
  std::string messageOf(const std::vector<std::string>& words) const {
    try {
      runFleet(arguments(words));
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  TemporaryDirectory directory_;
};

TEST_F(RunTest, wholeRobotsGiveTheSameFilesTwice) {
  std::vector<std::string> results, traces;
  for (const std::string run : {"1", "2"}) {
    runFleet(arguments({"--json", directory_.file(run + ".json"), "--trace", directory_.file(run + ".csv"), "--seed", "5"}));
    YAML::Node json = YAML::Load(contentsOf(directory_.file(run + ".json")));
    json.remove("wall");
    json.remove("timing_ms");
    YAML::Emitter text;
    text << json;
    results.push_back(text.c_str());
    traces.push_back(contentsOf(directory_.file(run + ".csv")));
  }
  EXPECT_EQ(results[0], results[1]);
  EXPECT_EQ(traces[0], traces[1]);
  EXPECT_NE(results[0].find("seed: 5"), std::string::npos);
}

TEST_F(RunTest, writesAPictureAndABag) {
  runFleet(arguments(
      {"--picture", directory_.file("p.png"), "--bag", directory_.file("r.bag"), "--bag-robot", "b", "--set", "duration=2"}));
  EXPECT_FALSE(cv::imread(directory_.file("p.png")).empty());
  const std::string bag = contentsOf(directory_.file("r.bag"));
  EXPECT_EQ(bag.rfind("#ROSBAG V2.0", 0), 0u);
  for (const std::string topic : {"/points", "/odom", "/tf", "/move_base_simple/goal", "/clock"})
    EXPECT_NE(bag.find(topic), std::string::npos) << topic;
}

TEST_F(RunTest, unusableInputIsSaidBeforeTheRun) {
  EXPECT_NE(messageOf({"--json", "/no/such/folder/r.json"}).find("--json: /no/such/folder/r.json: cannot be written"),
            std::string::npos);
  EXPECT_NE(messageOf({"--trace", "/no/such/folder/r.csv"}).find("--trace: "), std::string::npos);
  EXPECT_NE(messageOf({"--picture", "/no/such/folder/r.png"}).find("--picture: "), std::string::npos);
  EXPECT_NE(messageOf({"--bag", "/no/such/folder/r.bag"}).find("--bag: /no/such/folder/r.bag: cannot be written"),
            std::string::npos);
  EXPECT_NE(messageOf({"--bag", directory_.file("r.bag"), "--bag-robot", "z"}).find("--bag-robot: z: there is no such robot"),
            std::string::npos);
  EXPECT_NE(messageOf({"--set", "map=hall.yaml"}).find("s.yaml: map: no such file"), std::string::npos);
  EXPECT_EQ(messageOf({"--config", "/no/such/folder"}), "--config: /no/such/folder: no such folder");
  EXPECT_NE(messageOf({"--explain", "1", "z"}).find("--explain: z: there is no such robot"), std::string::npos);
}

TEST_F(RunTest, anUnreachableGoalIsARunThatFails) {
  const Result result = runFleet(arguments({"--set", "robots.0.goal=[50, 50]", "--set", "duration=5"}));
  EXPECT_FALSE(result.success);
  EXPECT_FALSE(result.robots[0].reached);
  EXPECT_FALSE(result.robots[0].shortest.has_value());
}

}  // namespace
}  // namespace parley::sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

// SPDX-License-Identifier: BSD-3-Clause
#include "parley_robot/config.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "parley_geometry/option_conformance.h"

namespace parley {
namespace {

class Config : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (std::filesystem::temp_directory_path() / "parley_config_XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::vector<std::string> load(const std::string& file, const std::string& text) {
    std::ofstream(folder_ / file) << text;
    return loadConfig(folder_.string(), options_);
  }

  std::filesystem::path folder_;
  RobotOptions options_;
};

TEST_F(Config, LoadsValuesOfEveryType) {
  EXPECT_TRUE(load("wiring.yaml", "plan_rate: 5\nplan_delay: 0.1\n").empty());
  EXPECT_EQ(options_.wiring.plan_rate, 5.0);
  EXPECT_EQ(options_.wiring.plan_delay, 0.1);
}

TEST_F(Config, NamesFileKeyAndReason) {
  const auto problems = load("wiring.yaml", "plan_rate: 5000\nplan_dealy: 0.1\ntopology_rate: fast\njump_angle: [1, 2]\n");
  ASSERT_EQ(problems.size(), 4U);
  for (const std::string& problem : problems) EXPECT_NE(problem.find("wiring.yaml"), std::string::npos) << problem;
  EXPECT_NE(problems[0].find("jump_angle: must be a single value"), std::string::npos) << problems[0];
  EXPECT_NE(problems[1].find("topology_rate: must be a number"), std::string::npos) << problems[1];
  EXPECT_NE(problems[2].find("plan_rate: value 5000 is not within [1, 50] Hz"), std::string::npos) << problems[2];
  EXPECT_NE(problems[3].find("plan_dealy: unknown key"), std::string::npos) << problems[3];
}

TEST_F(Config, RefusesBrokenYamlAndEmptyFolders) {
  EXPECT_EQ(loadConfig(folder_.string(), options_).size(), 1U);
  EXPECT_EQ(loadConfig((folder_ / "missing").string(), options_).size(), 1U);
  EXPECT_EQ(load("lidar.yaml", "bins: [720").size(), 1U);
  EXPECT_EQ(load("lidar.yaml", "- bins\n").size(), 1U);
  EXPECT_TRUE(load("lidar.yaml", "").empty());
}

TEST(ShippedConfiguration, loads) {
  RobotOptions loaded;
  for (const std::string& problem : loadConfig(PARLEY_CONFIG, loaded)) ADD_FAILURE() << problem;
}

TEST(WiringOptions, theFileHoldsTheDefaults) { expectFileHoldsDefaults<WiringOptions>(PARLEY_CONFIG "/wiring.yaml"); }

TEST(WiringOptions, theReadmeHoldsTheTable) { expectTableIn<WiringOptions>(PARLEY_ROBOT_README); }

TEST(WiringOptions, theDefaultsAreInRange) { expectDefaultsInRange<WiringOptions>(); }

TEST(CheckRobot, GeometryHasNoDefault) {
  RobotOptions options;
  options.name = "r";
  EXPECT_FALSE(checkRobot(options).empty());
  options.footprint = {0.8, 0.4};
  options.limits = {2.0, 1.5708, 2.0, 4.0};
  EXPECT_TRUE(checkRobot(options).empty());
  options.name.clear();
  EXPECT_EQ(checkRobot(options).size(), 1U);
}

TEST(CheckRobot, BootsHaveALimit) {
  RobotOptions options;
  options.name = "r";
  options.footprint = {0.8, 0.4};
  options.limits = {2.0, 1.5708, 2.0, 4.0};
  options.boot = (1U << 24) - 1;
  EXPECT_TRUE(checkRobot(options).empty());
  options.boot = 1U << 24;
  ASSERT_EQ(checkRobot(options).size(), 1U);
  EXPECT_NE(checkRobot(options).front().find("boot"), std::string::npos);
}

}  // namespace
}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

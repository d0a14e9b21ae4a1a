// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <filesystem>

#include "parley_sim/input_error.h"
#include "parley_sim/stack_brain.h"
#include "worlds.h"

namespace parley::sim {
namespace {

RobotSpec spec() {
  RobotSpec robot;
  robot.name = "robot_1";
  robot.start = {2.0, 5.0, 0.0};
  robot.goal = {8.0, 5.0};
  return robot;
}

RangeScan wallAhead(double stamp) {
  RangeScan scan;
  scan.stamp = stamp;
  scan.angle_increment = 2.0 * kPi / 720.0;
  scan.angle_min = -kPi + 0.5 * scan.angle_increment;
  scan.range_min = 0.05;
  scan.range_max = 4.0;
  for (int i = 0; i < 720; ++i) {
    const double ahead = std::cos(scan.angle_min + i * scan.angle_increment);
    const double range = ahead > 0.1 ? 2.0 / ahead : 9.0;
    scan.ranges.push_back(range < 4.0 ? static_cast<float>(range) : std::numeric_limits<float>::infinity());
  }
  return scan;
}

std::unique_ptr<Brain> brainAfter(double seconds) {
  std::unique_ptr<Brain> brain = stackBrains("", "full")(spec(), 0.3);
  for (int k = 0; k * 0.02 < seconds; ++k) {
    SensorReadings readings;
    readings.present = true;
    readings.clock = 0.02 * k;
    readings.odometry = Odometry{0.02 * k, {}, {}, 0.0, 0.0};
    if (k % 5 == 0) readings.scan = wallAhead(0.02 * k);
    brain->step(readings);
  }
  return brain;
}

}  // namespace

TEST(Explanation, saysWhatItKnewWantedAndDecided) {
  const std::string text = brainAfter(1.0)->explain("");
  for (const char* word :
       {"state      ", "odometry   ", "route      through unknown space", "plan       ", "committed  number "}) {
    EXPECT_NE(text.find(word), std::string::npos) << word << " is not in\n" << text;
  }
}

TEST(Explanation, drawsIt) {
  const TemporaryDirectory directory;
  const std::string file = directory.file("moment.png");
  brainAfter(1.0)->explain(file);
  EXPECT_GT(std::filesystem::file_size(file), 1000U);
  EXPECT_THROW(brainAfter(1.0)->explain(directory.file("missing/moment.png")), InputError);
}

TEST(Explanation, beforeAnythingIsSensedThereIsNothingToSay) {
  const std::unique_ptr<Brain> brain = stackBrains("", "full")(spec(), 0.3);
  EXPECT_NE(brain->explain("").find("odometry   none"), std::string::npos);
}

}  // namespace parley::sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

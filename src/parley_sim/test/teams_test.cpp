// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <sstream>

#include "parley_sim/result.h"
#include "parley_sim/run.h"
#include "worlds.h"

namespace parley::sim {
namespace {

const std::string kRoot = std::string(PARLEY_SIM_DIRECTORY) + "/../..";

/// Scenarios of maps/scenarios by name, separated by commas.
std::vector<std::string> scenarios() {
  std::vector<std::string> names;
  std::istringstream list(PARLEY_TEAM_SCENARIOS);
  for (std::string name; std::getline(list, name, ',');) names.push_back(name);
  return names;
}

struct Row {
  double time = 0.0, speed = 0.0, turn_rate = 0.0;
};

/// Rows of a trace by robot. Its columns are time, robot, x, y, yaw, speed, turn rate, state.
std::map<std::string, std::vector<Row>> rowsOf(const std::string& trace) {
  std::map<std::string, std::vector<Row>> rows;
  std::istringstream lines(trace);
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    std::vector<std::string> cell;
    for (std::string text; std::getline(cells, text, ',');) cell.push_back(text);
    rows[cell.at(1)].push_back({std::stod(cell.at(0)), std::stod(cell.at(5)), std::stod(cell.at(6))});
  }
  return rows;
}

class TeamsTest : public testing::TestWithParam<std::string> {
 protected:
  TemporaryDirectory directory_;
};

TEST_P(TeamsTest, AllArriveNobodyTouchesAnythingAndLimitsHold) {
  const std::string trace = directory_.file("trace.csv");
  const Result result = runFleet(parseArguments(
      {kRoot + "/maps/scenarios/" + GetParam() + ".yaml", "--quiet", "--config", kRoot + "/config", "--trace", trace}));
  EXPECT_TRUE(result.success);
  EXPECT_EQ(result.collisions(), 0);
  // Nobody is taken for somebody else.
  EXPECT_LT(result.translation_error_max.value_or(0.0), 0.5);
  EXPECT_LT(result.rotation_error_max.value_or(0.0), 0.1);
  for (const auto& [robot, rows] : rowsOf(contentsOf(trace))) {
    for (std::size_t i = 1; i < rows.size(); ++i) {
      const double dt = rows[i].time - rows[i - 1].time;
      ASSERT_LE(std::abs(rows[i].speed), 2.0 + 1e-3) << robot << " at " << rows[i].time;
      ASSERT_LE(std::abs(rows[i].turn_rate), 1.5708 + 1e-3) << robot << " at " << rows[i].time;
      ASSERT_LE(std::abs(rows[i].speed - rows[i - 1].speed), 2.0 * dt + 2e-3) << robot << " at " << rows[i].time;
      ASSERT_LE(std::abs(rows[i].turn_rate - rows[i - 1].turn_rate), 4.0 * dt + 2e-3) << robot << " at " << rows[i].time;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scenarios, TeamsTest, testing::ValuesIn(scenarios()), [](const auto& made) {
  std::string name = made.param;
  for (char& letter : name) letter = std::isalnum(static_cast<unsigned char>(letter)) ? letter : '_';
  return name;
});

}  // namespace
}  // namespace parley::sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

#include "parley_control/control_options.h"
#include "parley_geometry/options.h"

namespace parley {
namespace {

std::string readFile(const std::string& path) {
  std::ifstream file(path);
  EXPECT_TRUE(file.good()) << path;
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// Lines `key: number  # comment`: all that this file needs of YAML.
OptionValues readNumbers(const std::string& text) {
  OptionValues values;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    line = line.substr(0, line.find('#'));
    const std::size_t colon = line.find(':');
    if (colon != std::string::npos) values[line.substr(0, colon)] = std::stod(line.substr(colon + 1));
  }
  return values;
}

TEST(Config, fileIsCompleteAndEqualsTheDefaults) {
  const OptionValues values = readNumbers(readFile(PACKAGE_DIRECTORY "/../../config/control.yaml"));
  EXPECT_EQ(values, valuesOf(listOptions(ControlOptions{})));
  ControlOptions options;
  const auto problems = loadOptions(options, values, "control.yaml");
  EXPECT_TRUE(problems.empty()) << problems.front();
}

TEST(Config, defaultsAreWithinTheirRanges) { EXPECT_TRUE(checkOptions(ControlOptions{}, "defaults").empty()); }

TEST(Config, readmeShowsTheOptionsAsTheyAre) {
  const std::string table = optionTable(listOptions(ControlOptions{}));
  EXPECT_NE(readFile(PACKAGE_DIRECTORY "/README.md").find(table), std::string::npos) << "the table should be\n" << table;
}

}  // namespace
}  // namespace parley

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

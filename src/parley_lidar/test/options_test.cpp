// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "parley_geometry/options.h"
#include "parley_lidar/lidar_options.h"

namespace parley {
namespace {

/// Values of a flat YAML file with numbers and comments in it.
OptionValues readFlat(const std::string& path) {
  OptionValues values;
  std::ifstream file(path);
  EXPECT_TRUE(file) << path;
  for (std::string line; std::getline(file, line);) {
    line = line.substr(0, line.find('#'));
    const std::size_t colon = line.find(':');
    if (colon == std::string::npos) continue;
    const std::string text = line.substr(line.find_first_not_of(' ', colon + 1));
    if (text.find('.') == std::string::npos) {
      values[line.substr(0, colon)] = std::stol(text);
    } else {
      values[line.substr(0, colon)] = std::stod(text);
    }
  }
  return values;
}

TEST(LidarOptions, DefaultsAreWithinTheirOwnLimits) {
  EXPECT_TRUE(checkOptions(LidarOptions{}, "lidar").empty());
  EXPECT_TRUE(checkOptions(LidarMount{}, "mount").empty());
}

TEST(LidarOptions, TheConfigFileHoldsAllDefaults) {
  const OptionValues values = readFlat(PARLEY_CONFIG_DIR "/lidar.yaml");
  LidarOptions options;
  for (const std::string& problem : loadOptions(options, values, "lidar.yaml")) ADD_FAILURE() << problem;
  const std::vector<OptionInfo> defaults = listOptions(LidarOptions{}), loaded = listOptions(options);
  EXPECT_EQ(values.size(), defaults.size());
  for (std::size_t i = 0; i < defaults.size(); ++i) {
    EXPECT_EQ(values.count(defaults[i].name), 1U) << defaults[i].name;
    EXPECT_EQ(loaded[i].value, defaults[i].value) << defaults[i].name;
  }
}

TEST(LidarOptions, TheReadmeListsThem) {
  std::ifstream file(PARLEY_LIDAR_DIR "/README.md");
  std::stringstream readme;
  readme << file.rdbuf();
  for (const std::string& table : {optionTable(listOptions(LidarOptions{})), optionTable(listOptions(LidarMount{}))}) {
    EXPECT_NE(readme.str().find(table), std::string::npos) << "README.md should hold:\n" << table;
  }
}

}  // namespace
}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

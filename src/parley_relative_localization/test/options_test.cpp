// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "parley_relative_localization/relative_localization_options.h"

namespace parley {
namespace {

/// `key: value` lines with comments.
OptionValues readFlat(const std::string& path) {
  OptionValues values;
  std::ifstream file(path);
  EXPECT_TRUE(file.good()) << path;
  for (std::string line; std::getline(file, line);) {
    line = line.substr(0, line.find('#'));
    const std::size_t colon = line.find(':');
    if (colon == std::string::npos) continue;
    const std::string key = line.substr(0, colon);
    std::string text;
    std::istringstream(line.substr(colon + 1)) >> text;
    char* end = nullptr;
    const double number = std::strtod(text.c_str(), &end);
    if (text == "true" || text == "false") {
      values[key] = text == "true";
    } else if (*end != '\0') {
      values[key] = text;
    } else if (text.find_first_of(".e") == std::string::npos) {
      values[key] = static_cast<long>(number);
    } else {
      values[key] = number;
    }
  }
  return values;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

}  // namespace

TEST(RelativeLocalizationOptions, theFileHoldsTheDefaults) {
  const OptionValues values = readFlat(RELATIVE_LOCALIZATION_YAML);
  RelativeLocalizationOptions loaded;
  EXPECT_EQ(joined(loadOptions(loaded, values, "relative_localization.yaml")), "");
  const std::vector<OptionInfo> expected = listOptions(RelativeLocalizationOptions()), infos = listOptions(loaded);
  EXPECT_EQ(values.size(), expected.size());
  for (std::size_t i = 0; i < infos.size(); ++i) {
    EXPECT_EQ(infos[i].value, expected[i].value) << infos[i].name;
    EXPECT_TRUE(values.count(infos[i].name)) << infos[i].name;
  }
}

TEST(RelativeLocalizationOptions, theReadmeHoldsTheTable) {
  std::ifstream file(RELATIVE_LOCALIZATION_README);
  std::stringstream text;
  text << file.rdbuf();
  EXPECT_NE(text.str().find(optionTable(listOptions(RelativeLocalizationOptions()))), std::string::npos)
      << "the table should be:\n"
      << optionTable(listOptions(RelativeLocalizationOptions()));
}

TEST(RelativeLocalizationOptions, defaultsAreWithinTheirRanges) {
  EXPECT_EQ(joined(checkOptions(RelativeLocalizationOptions(), "defaults")), "");
}

}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

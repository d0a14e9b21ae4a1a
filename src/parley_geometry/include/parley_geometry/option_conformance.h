// SPDX-License-Identifier: BSD-3-Clause
// For tests alone: what every package with options promises of its file in config/ and of the table in its README.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "parley_geometry/options.h"

namespace parley {

/// The values of a file of `key: value  # comment` lines, which is all that these files use of YAML.
inline OptionValues flatOptionFile(const std::string& path) {
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
    } else if (text.empty() || *end != '\0') {
      values[key] = text;
    } else if (text.find_first_of(".e") == std::string::npos) {
      values[key] = static_cast<long>(number);
    } else {
      values[key] = number;
    }
  }
  return values;
}

/// The file names each option once, with its default.
template <class Options>
void expectFileHoldsDefaults(const std::string& path) {
  const OptionValues values = flatOptionFile(path);
  Options loaded;
  for (const std::string& problem : loadOptions(loaded, values, path)) ADD_FAILURE() << problem;
  const std::vector<OptionInfo> expected = listOptions(Options{}), found = listOptions(loaded);
  EXPECT_EQ(values.size(), expected.size()) << path;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(values.count(expected[i].name), 1U) << expected[i].name << " is not in " << path;
    EXPECT_EQ(found[i].value, expected[i].value) << expected[i].name;
  }
}

/// The file holds the table of the options as they are.
template <class Options>
void expectTableIn(const std::string& path) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  const std::string table = optionTable(listOptions(Options{}));
  EXPECT_NE(text.str().find(table), std::string::npos) << path << " should hold\n" << table;
}

template <class Options>
void expectDefaultsInRange() {
  for (const std::string& problem : checkOptions(Options{}, "defaults")) ADD_FAILURE() << problem;
}

}  // namespace parley

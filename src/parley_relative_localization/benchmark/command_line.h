// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace parley::study {

/// Where the values of a study's options go.
struct CommandLine {
  std::map<std::string, double*> numbers;
  std::map<std::string, int*> counts;
  std::map<std::string, bool*> flags;  // set by their names alone
  unsigned seed = 1;                   // of --seed
  std::string json;                    // of --json: the file of results

  /// Fills them; returns the arguments that are no options. Throws std::invalid_argument for an option that is not known, lacks
  /// its value, or has one that is no number.
  std::vector<std::string> parse(int argc, char** argv) {
    std::vector<std::string> rest;
    for (int i = 1; i < argc; ++i) {
      const std::string key = argv[i];
      const bool has_value = i + 1 < argc;
      if (flags.count(key) > 0) {
        *flags.at(key) = true;
      } else if (numbers.count(key) > 0 && has_value) {
        *numbers.at(key) = std::stod(argv[++i]);
      } else if (counts.count(key) > 0 && has_value) {
        *counts.at(key) = std::stoi(argv[++i]);
      } else if (key == "--seed" && has_value) {
        seed = static_cast<unsigned>(std::stoul(argv[++i]));
      } else if (key == "--json" && has_value) {
        json = argv[++i];
      } else if (key.rfind("--", 0) == 0) {
        throw std::invalid_argument("unknown argument " + key + ", or it has no value");
      } else {
        rest.push_back(key);
      }
    }
    return rest;
  }
};

}  // namespace parley::study

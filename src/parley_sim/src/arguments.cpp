// SPDX-License-Identifier: BSD-3-Clause
#include "parley_sim/arguments.h"

#include <algorithm>
#include <cstdlib>
#include <map>

#include "parley_sim/input_error.h"
#include "parley_sim/stack_brain.h"

namespace parley::sim {
namespace {

bool endsWith(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

Override overrideOf(const std::string& word) {
  const std::size_t equals = word.find('=');
  if (equals == std::string::npos || equals == 0) throw InputError("--set: " + word + ": must be KEY=VALUE");
  return {word.substr(0, equals), word.substr(equals + 1)};
}

Question questionOf(const std::string& time, const std::string& robot) {
  char* end = nullptr;
  Question question{std::strtod(time.c_str(), &end), robot};
  if (time.empty() || *end != '\0' || !(question.time >= 0.0))
    throw InputError("--explain: " + time + ": must be a time in seconds from 0 on");
  return question;
}

void check(const Arguments& arguments, const std::string& seed) {
  if (arguments.scenario.empty()) throw InputError("SCENARIO.yaml: is missing; see fleet_run --help");
  if (!seed.empty() && (seed.find_first_not_of("0123456789") != std::string::npos || seed.size() > 15)) {
    throw InputError("--seed: " + seed + ": must be a whole number from 0 on");
  }
  const std::vector<std::string>& variants = variantNames();
  if (std::find(variants.begin(), variants.end(), arguments.variant) == variants.end()) {
    throw InputError("--variant: " + arguments.variant + ": must be full, no_sharing, no_conflict_resolution or reactive");
  }
  if (!arguments.picture.empty() && !endsWith(arguments.picture, ".png")) {
    throw InputError("--picture: " + arguments.picture + ": must end in .png");
  }
  if (!arguments.bag_robot.empty() && arguments.bag.empty()) throw InputError("--bag-robot: needs --bag");
}

}  // namespace

Arguments parseArguments(const std::vector<std::string>& words) {
  Arguments arguments;
  std::string seed;
  const std::map<std::string, std::string*> texts{
      {"--seed", &seed},           {"--variant", &arguments.variant},    {"--config", &arguments.config},
      {"--json", &arguments.json}, {"--trace", &arguments.trace},        {"--picture", &arguments.picture},
      {"--bag", &arguments.bag},   {"--bag-robot", &arguments.bag_robot}};
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    const auto text = texts.find(word);
    if (word == "--help" || word == "-h") {
      arguments.help = true;
      return arguments;
    }
    if (word == "--quiet") {
      arguments.quiet = true;
    } else if (text != texts.end() || word == "--set") {
      if (i + 1 == words.size() || words[i + 1].empty()) throw InputError(word + ": its value is missing");
      ++i;
      if (word == "--set") {
        arguments.overrides.push_back(overrideOf(words[i]));
      } else {
        *text->second = words[i];
      }
    } else if (word == "--explain") {
      if (i + 2 >= words.size()) throw InputError("--explain: needs TIME and ROBOT");
      arguments.questions.push_back(questionOf(words[i + 1], words[i + 2]));
      i += 2;
    } else if (word.rfind('-', 0) == 0) {
      throw InputError(word + ": unknown argument; see fleet_run --help");
    } else if (!arguments.scenario.empty()) {
      throw InputError(word + ": one scenario at a time, there is " + arguments.scenario + " already");
    } else {
      arguments.scenario = word;
    }
  }
  check(arguments, seed);
  if (!seed.empty()) arguments.overrides.emplace_back("seed", seed);
  return arguments;
}

const char* usage() {
  return "usage: fleet_run SCENARIO.yaml [options]\n"
         "Runs a scenario with whole robots in lockstep simulated time.\n"
         "  --seed N             instead of the scenario's\n"
         "  --variant NAME       full (default), no_sharing, no_conflict_resolution or reactive\n"
         "  --set KEY=VALUE      any key of the scenario by its dotted path, list items by index; may be repeated\n"
         "  --config DIR         folder with one YAML file of options a stage\n"
         "  --json FILE          result\n"
         "  --trace FILE         true motion of every robot, ten times a second, as CSV\n"
         "  --picture FILE.png   map and tracks\n"
         "  --bag FILE           one robot's topics for replay\n"
         "  --bag-robot NAME     which robot's, the first if not said\n"
         "  --explain TIME ROBOT what it knew, wanted and decided then, as text and a picture; may be repeated\n"
         "  --quiet              no progress\n"
         "Exit status: 0 success, 1 the run ended otherwise, 2 unusable arguments or files.\n";
}

}  // namespace parley::sim

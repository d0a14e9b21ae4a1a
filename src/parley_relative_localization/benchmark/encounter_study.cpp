// SPDX-License-Identifier: BSD-3-Clause
// How often, how soon and how well robots that meet find each other, and whether robots elsewhere ever believe they do.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>

#include "encounter.h"

namespace parley::study {
namespace {

struct Arguments {
  StudyOptions study;
  int encounters = 200, elsewhere = 0;  // [-] in all worlds together
  unsigned seed = 1;
  std::string json;
  std::vector<std::string> worlds;
};

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5)];
}

/// Sums over the encounters of a world, or of all.
struct Tally {
  int encounters = 0, confirmed = 0, early = 0, tentative = 0, wrong = 0, elsewhere = 0, wrong_elsewhere = 0;  // [-]
  std::vector<double> translation, rotation, travel, seconds, bytes, descriptors, consistency, steps;

  void add(const Outcome& outcome) {
    wrong += outcome.wrong ? 1 : 0;
    steps.insert(steps.end(), outcome.step_seconds.begin(), outcome.step_seconds.end());
    descriptors.insert(descriptors.end(), outcome.descriptor_bytes.begin(), outcome.descriptor_bytes.end());
    if (!outcome.is_encounter) return;
    ++encounters;
    bytes.push_back(outcome.bytes);
    tentative += outcome.tentative ? 1 : 0;
    if (!outcome.confirmed) return;
    ++confirmed;
    early += outcome.travel <= 2.0 ? 1 : 0;
    translation.push_back(outcome.translation_error);
    rotation.push_back(degrees(outcome.rotation_error));
    travel.push_back(outcome.travel);
    seconds.push_back(outcome.seconds);
    consistency.push_back(outcome.consistency);
  }

  void addElsewhere(const Outcome& outcome) {
    ++elsewhere;
    wrong_elsewhere += outcome.confirmed ? 1 : 0;
    steps.insert(steps.end(), outcome.step_seconds.begin(), outcome.step_seconds.end());
  }

  void print(const std::string& name) const {
    std::printf(
        "%-20s %5d %5d %5.1f%% %5.1f%% %5.1f%% %4d %5d %4d  %5.3f %5.3f  %5.2f %5.2f  %5.2f %5.2f  %4.0f %4.0f  %5.2f %5.2f "
        "%4.1f\n",
        name.c_str(), encounters, confirmed, 100.0 * confirmed / std::max(encounters, 1),
        100.0 * tentative / std::max(encounters, 1), 100.0 * early / std::max(confirmed, 1), wrong, elsewhere, wrong_elsewhere,
        quantile(translation, 0.5), quantile(translation, 0.95), quantile(rotation, 0.5), quantile(rotation, 0.95),
        quantile(travel, 0.5), quantile(seconds, 0.5), quantile(bytes, 0.5), quantile(descriptors, 0.5),
        1e3 * quantile(steps, 0.5), 1e3 * quantile(steps, 0.99), quantile(consistency, 0.5));
    std::fflush(stdout);
  }

  std::string json() const {
    char text[1024];
    std::snprintf(
        text, sizeof(text),
        "{\"encounters\": %d, \"confirmed\": %d, \"tentative\": %d, \"within_two_metres\": %d, \"wrong\": %d, \"elsewhere\": %d, "
        "\"wrong_elsewhere\": %d, \"translation_error\": {\"p50\": %.4f, \"p95\": %.4f}, \"rotation_error_degrees\": "
        "{\"p50\": %.3f, \"p95\": %.3f}, \"joint_travel\": {\"p50\": %.2f}, \"seconds\": {\"p50\": %.2f}, "
        "\"bytes\": {\"p50\": %.0f, \"p95\": %.0f}, \"descriptor_bytes\": {\"p50\": %.0f, \"p99\": %.0f}, "
        "\"match_ms\": {\"p50\": %.3f, \"p99\": %.3f}, \"consistency\": {\"p50\": %.2f, \"p95\": %.2f}}",
        encounters, confirmed, tentative, early, wrong, elsewhere, wrong_elsewhere, quantile(translation, 0.5),
        quantile(translation, 0.95), quantile(rotation, 0.5), quantile(rotation, 0.95), quantile(travel, 0.5),
        quantile(seconds, 0.5), quantile(bytes, 0.5), quantile(bytes, 0.95), quantile(descriptors, 0.5),
        quantile(descriptors, 0.99), 1e3 * quantile(steps, 0.5), 1e3 * quantile(steps, 0.99), quantile(consistency, 0.5),
        quantile(consistency, 0.95));
    return text;
  }
};

Arguments parse(int argc, char** argv) {
  Arguments arguments;
  StudyOptions& study = arguments.study;
  const std::map<std::string, double*> numbers{{"--range", &study.lidar.range}, {"--noise", &study.lidar.noise},
                                               {"--drift", &study.drift},       {"--offset", &study.offset},
                                               {"--loss", &study.loss},         {"--speed", &study.speed}};
  const std::map<std::string, int*> counts{{"--encounters", &arguments.encounters},
                                           {"--elsewhere", &arguments.elsewhere},
                                           {"--clutter", &study.clutter},
                                           {"--beams", &study.lidar.beams}};
  for (int i = 1; i < argc; ++i) {
    const std::string key = argv[i];
    const bool has_value = i + 1 < argc;
    if (numbers.count(key) > 0 && has_value) {
      *numbers.at(key) = std::stod(argv[++i]);
    } else if (counts.count(key) > 0 && has_value) {
      *counts.at(key) = std::stoi(argv[++i]);
    } else if (key == "--seed" && has_value) {
      arguments.seed = static_cast<unsigned>(std::stoul(argv[++i]));
    } else if (key == "--json" && has_value) {
      arguments.json = argv[++i];
    } else if (key.rfind("--", 0) == 0) {
      throw std::invalid_argument("unknown argument " + key);
    } else {
      arguments.worlds.push_back(key);
    }
  }
  return arguments;
}

GridWorld worldOf(const std::string& name) {
  if (name == "periodic") return GridWorld::periodic();
  if (name == "mirrored") return GridWorld::mirrored();
  return GridWorld::load(name);
}

using RunOne = std::optional<Outcome> (*)(const GridWorld&, const StudyOptions&, unsigned);

/// So many outcomes; encounters count only if the robots saw each other for a second.
void gather(const GridWorld& world, const Arguments& arguments, int wanted, RunOne run, bool elsewhere, Tally& own, Tally& all) {
  for (int trial = 0; trial < 4 * wanted && (elsewhere ? own.elsewhere : own.encounters) < wanted; ++trial) {
    const auto outcome = run(world, arguments.study, arguments.seed * 1000003U + static_cast<unsigned>(trial) * 7919U);
    if (!outcome) continue;
    for (Tally* tally : {&own, &all}) elsewhere ? tally->addElsewhere(*outcome) : tally->add(*outcome);
  }
}

int study(int argc, char** argv) {
  const Arguments arguments = parse(argc, argv);
  std::vector<std::string> names = arguments.worlds;
  if (names.empty()) names = {"mirrored", "periodic"};
  std::printf(
      "world                  enc  conf  share  tent  <=2m  wrong else wrong  m p50  p95   deg p50 p95   travel sec    byte desc "
      "  ms p50 p99  chi\n");
  Tally all, all_but_periodic;
  std::string json = "{";
  const int share = static_cast<int>(names.size());
  for (const std::string& name : names) {
    const GridWorld world = worldOf(name);
    Tally own;
    Tally& sum = name == "periodic" ? all : all_but_periodic;
    gather(world, arguments, (arguments.encounters + share - 1) / share, runEncounter, false, own, sum);
    gather(world, arguments, (arguments.elsewhere + share - 1) / share, runElsewhere, true, own, sum);
    own.print(world.name());
    json += "\"" + world.name() + "\": " + own.json() + ",\n";
  }
  all_but_periodic.print("all but periodic");
  if (!arguments.json.empty())
    std::ofstream(arguments.json) << json << "\"all_but_periodic\": " << all_but_periodic.json() << "}\n";
  return 0;
}

}  // namespace
}  // namespace parley::study

int main(int argc, char** argv) {
  try {
    return parley::study::study(argc, argv);
  } catch (const std::exception& problem) {
    std::fprintf(stderr, "encounter_study: %s\n", problem.what());
    return 2;
  }
}

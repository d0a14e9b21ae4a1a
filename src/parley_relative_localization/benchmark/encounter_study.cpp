// SPDX-License-Identifier: BSD-3-Clause
// How often, how soon and how well robots that meet find each other, and whether robots elsewhere ever believe they do.
#include <cstdio>
#include <fstream>
#include <string>

#include "command_line.h"
#include "encounter.h"
#include "tally.h"

namespace parley::study {
namespace {

struct Arguments {
  StudyOptions study;
  int encounters = 200, elsewhere = 0;  // [-] in all worlds together
  unsigned seed = 1;
  std::string json;
  std::vector<std::string> worlds;
};

Arguments parse(int argc, char** argv) {
  Arguments arguments;
  StudyOptions& study = arguments.study;
  CommandLine line;
  line.numbers = {{"--range", &study.lidar.range}, {"--noise", &study.lidar.noise}, {"--drift", &study.drift},
                  {"--offset", &study.offset},     {"--loss", &study.loss},         {"--speed", &study.speed}};
  line.counts = {{"--encounters", &arguments.encounters},
                 {"--elsewhere", &arguments.elsewhere},
                 {"--clutter", &study.clutter},
                 {"--beams", &study.lidar.beams}};
  arguments.worlds = line.parse(argc, argv);
  arguments.seed = line.seed;
  arguments.json = line.json;
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
  Tally::printHead();
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

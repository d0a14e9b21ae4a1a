// SPDX-License-Identifier: BSD-3-Clause
// Whether robots made of stretches of real logs ever believe a wrong pose, how often they find each other, and how well.
#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <string>

#include "command_line.h"
#include "log_replay.h"
#include "tally.h"

namespace parley::study {
namespace {

struct Arguments {
  ReplayOptions replay;
  int encounters = 100, elsewhere = 100;  // [-] a log
  unsigned seed = 1;
  std::string json;
  std::vector<std::string> logs;
};

Arguments parse(int argc, char** argv) {
  Arguments arguments;
  StudyOptions& study = arguments.replay.study;
  bool unpainted = false;
  CommandLine line;
  line.numbers = {{"--range", &study.lidar.range},
                  {"--drift", &study.drift},
                  {"--offset", &study.offset},
                  {"--loss", &study.loss},
                  {"--speed", &study.speed}};
  line.counts = {{"--encounters", &arguments.encounters}, {"--elsewhere", &arguments.elsewhere}};
  line.flags = {{"--unpainted", &unpainted}, {"--scans-alone", &arguments.replay.scans_alone}};
  arguments.logs = line.parse(argc, argv);
  arguments.seed = line.seed;
  arguments.json = line.json;
  arguments.replay.paint = !unpainted;
  if (arguments.logs.empty()) throw std::invalid_argument("no log given: log_study [OPTION VALUE]... LOG[.gz]...");
  return arguments;
}

using ReplayOne = std::optional<Outcome> (*)(const CarmenLog&, const std::vector<Meeting>&, const ReplayOptions&, unsigned);

/// So many outcomes; encounters count only if the robots were in each other's view for a second.
void gather(const CarmenLog& log, const std::vector<Meeting>& meetings, const Arguments& arguments, bool elsewhere, Tally& own,
            Tally& all) {
  const ReplayOne replay = elsewhere ? replayElsewhere : replayEncounter;
  const int wanted = elsewhere ? arguments.elsewhere : arguments.encounters;
  for (int trial = 0; trial < 40 * wanted && (elsewhere ? own.elsewhere : own.encounters) < wanted; ++trial) {
    const auto outcome =
        replay(log, meetings, arguments.replay, arguments.seed * 1000003U + static_cast<unsigned>(trial) * 7919U);
    if (!outcome) continue;
    for (Tally* tally : {&own, &all}) elsewhere ? tally->addElsewhere(*outcome) : tally->add(*outcome);
  }
}

int study(int argc, char** argv) {
  constexpr int kApart = 40;         // [-] scans
  constexpr double kNearest = 1.5;   // [m]
  constexpr double kFarthest = 3.5;  // [m]
  const Arguments arguments = parse(argc, argv);
  Tally::printHead();
  Tally all;
  std::string json = "{";
  for (const std::string& path : arguments.logs) {
    const CarmenLog log = readCarmenLog(path);
    const std::vector<Meeting> meetings = findMeetings(log, kApart, kNearest, kFarthest);
    if (log.malformed > 0) std::printf("%s: %d malformed lines left out\n", log.name.c_str(), log.malformed);
    Tally own;
    for (const bool elsewhere : {false, true}) gather(log, meetings, arguments, elsewhere, own, all);
    own.print(log.name);
    json += "\"" + log.name + "\": " + own.json() + ",\n";
  }
  all.print("all");
  if (!arguments.json.empty()) std::ofstream(arguments.json) << json << "\"all\": " << all.json() << "}\n";
  return all.wrong + all.wrong_elsewhere == 0 ? 0 : 1;
}

}  // namespace
}  // namespace parley::study

int main(int argc, char** argv) {
  try {
    return parley::study::study(argc, argv);
  } catch (const std::exception& problem) {
    std::fprintf(stderr, "log_study: %s\n", problem.what());
    return 2;
  }
}

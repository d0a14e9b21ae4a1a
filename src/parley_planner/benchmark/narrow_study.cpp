// SPDX-License-Identifier: BSD-3-Clause
// The lattice search for narrow places beside OMPL's RRTConnect and RRT* on the same random problems:
// narrow_study [--problems N] [--seed N] [--clearance METRES] [--range SECONDS]
#include <algorithm>
#include <cstdio>
#include <map>
#include <stdexcept>
#include <string>

#include "narrow_search.h"
#include "sampling_search.h"
#include "scenes.h"
#include "trajectory_validator.h"

namespace parley::study {
namespace {

constexpr double kTimeStep = 0.05;  // [s]

struct Arguments {
  int problems = 400;       // [-]
  unsigned seed = 1;        // of the first problem
  double clearance = 0.05;  // [m] as the planner asks first
  double range = 1.0;       // [s] of one motion of OMPL's trees
};

struct Method {
  std::string name;
  int expansions = 0;       // [-] of the lattice search; 0: OMPL
  bool optimal = false;     // RRT*
  double time_limit = 0.0;  // [s] of OMPL
};

const std::vector<Method>& methods() {
  static const std::vector<Method> all{{"lattice 4000", 4000, false, 0.0},     {"lattice 20000", 20000, false, 0.0},
                                       {"lattice 100000", 100000, false, 0.0}, {"RRTConnect 10 ms", 0, false, 0.01},
                                       {"RRTConnect 50 ms", 0, false, 0.05},   {"RRTConnect 200 ms", 0, false, 0.2},
                                       {"RRT* 200 ms", 0, true, 0.2}};
  return all;
}

struct Answer {
  bool found = false, repeats = false, touches = false, refused = false;
  double cpu = 0.0;      // [s]
  double seconds = 0.0;  // [s] that the motion takes
  int stops = 0;         // [-]
};

/// All that was answered to a problem, by method.
struct Record {
  Place place = Place::kSlot;
  bool meant_closed = false, open = false;
  std::vector<Answer> answers;
};

/// What the drive can do, as the planner plans with it.
MotionLimits plannedLimits() {
  const MotionLimits all = robotLimits();
  const double share = PlannerOptions().limit_share;
  return {all.speed, all.turn_rate * share, all.acceleration * share, all.turn_acceleration * share};
}

std::vector<TrajectoryPoint> search(const Method& method, const NarrowProblem& problem, const FootprintProbe& probe,
                                    const Arguments& arguments, unsigned seed) {
  const MotionLimits limits = plannedLimits();
  if (method.expansions > 0) {
    return searchNarrow({0.0, problem.start, {}}, problem.target, problem.surroundings, probe, limits, kTimeStep,
                        {method.expansions, arguments.clearance, NarrowSearchOptions().slow_speed});
  }
  SamplingOptions options;
  options.optimal = method.optimal;
  options.time_limit = method.time_limit;
  options.range = arguments.range;
  options.clearance = arguments.clearance;
  options.seed = seed;
  return searchBySampling(problem, probe, limits, kTimeStep, options);
}

bool sameBits(const std::vector<TrajectoryPoint>& a, const std::vector<TrajectoryPoint>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const TrajectoryPoint& p, const TrajectoryPoint& q) {
    return p.time == q.time && p.pose == q.pose && p.twist.speed == q.twist.speed && p.twist.turn_rate == q.twist.turn_rate;
  });
}

/// The planner's last word on a motion.
bool isRefused(const std::vector<TrajectoryPoint>& points, const NarrowProblem& problem, double clearance) {
  TrajectoryValidator validator(robotFootprint(), robotLimits(), 1.5, 0.1);
  const LocalMap map = seenMap(problem.world);
  const std::vector<TrackedObject> tracks;
  const ObstacleScan scan;
  validator.observe({map, scan, {}, tracks});
  return !validator.check(SampledTrajectory(points), points.front(), {std::max(0.02, 0.4 * clearance), 0.02, 0.2}).good();
}

Answer answerOf(const Method& method, const NarrowProblem& problem, const FootprintProbe& probe, const Arguments& arguments,
                unsigned seed) {
  Answer answer;
  const double begin = threadSeconds();
  const std::vector<TrajectoryPoint> points = search(method, problem, probe, arguments, seed);
  answer.cpu = threadSeconds() - begin;
  answer.repeats = sameBits(points, search(method, problem, probe, arguments, seed));
  answer.found = !points.empty();
  if (!answer.found) return answer;
  answer.seconds = points.back().time;
  answer.refused = isRefused(points, problem, arguments.clearance);
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Twist2& twist = points[i].twist;
    answer.stops += twist.speed == 0.0 && twist.turn_rate == 0.0;
    answer.touches = answer.touches || problem.world.touches(robotFootprint(), points[i].pose);
  }
  return answer;
}

Record solve(unsigned seed, const Arguments& arguments) {
  const FootprintProbe probe(robotFootprint());
  const NarrowProblem problem = narrowProblem(seed, arguments.clearance);
  Record record{problem.place, problem.meant_closed, isOpen(problem, probe, arguments.clearance), {}};
  for (const Method& method : methods()) {
    record.answers.push_back(answerOf(method, problem, probe, arguments, seed));
    record.open = record.open || record.answers.back().found;
  }
  return record;
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5)];
}

void printSuccess(const std::vector<Record>& records) {
  std::printf("\n| found of the open ones |");
  for (int place = 0; place < kPlaces; ++place) std::printf(" %s |", nameOf(static_cast<Place>(place)));
  std::printf(" all |\n|---|---|---|---|---|---|\n");
  for (std::size_t m = 0; m < methods().size(); ++m) {
    std::vector<int> found(kPlaces + 1), open(kPlaces + 1);
    for (const Record& record : records) {
      for (const int column : {static_cast<int>(record.place), kPlaces}) {
        open[static_cast<std::size_t>(column)] += record.open;
        found[static_cast<std::size_t>(column)] += record.open && record.answers[m].found;
      }
    }
    std::printf("| %s |", methods()[m].name.c_str());
    for (std::size_t column = 0; column <= kPlaces; ++column) std::printf(" %d of %d |", found[column], open[column]);
    std::printf("\n");
  }
}

/// CPU time, the motion and its faults, for one method; motions are compared where the first method found one too.
void printQuality(const std::vector<Record>& records, std::size_t m) {
  std::vector<double> cpu, cpu_closed, seconds, ratio, stops;
  int repeats = 0, refused = 0, touches = 0, quicker = 0, closed_found = 0;
  for (const Record& record : records) {
    const Answer &answer = record.answers[m], &first = record.answers.front();
    repeats += answer.repeats;
    refused += answer.refused;
    touches += answer.touches;
    (record.open ? cpu : cpu_closed).push_back(1e3 * answer.cpu);
    closed_found += record.meant_closed && answer.found;
    if (!answer.found || !first.found) continue;
    seconds.push_back(answer.seconds);
    stops.push_back(answer.stops);
    ratio.push_back(answer.seconds / first.seconds);
    quicker += answer.seconds < 0.95 * first.seconds;
  }
  std::printf("| %s | %.1f / %.1f / %.1f | %.1f / %.1f | %.1f / %.1f | %.2f | %d of %zu | %.0f | %zu of %zu | %d | %d | %d |\n",
              methods()[m].name.c_str(), quantile(cpu, 0.5), quantile(cpu, 0.99), quantile(cpu, 1.0), quantile(cpu_closed, 0.5),
              quantile(cpu_closed, 0.99), quantile(seconds, 0.5), quantile(seconds, 0.95), quantile(ratio, 0.5), quicker,
              ratio.size(), quantile(stops, 0.5), static_cast<std::size_t>(repeats), records.size(), refused, touches,
              closed_found);
}

void print(const std::vector<Record>& records) {
  const auto open = std::count_if(records.begin(), records.end(), [](const Record& record) { return record.open; });
  const auto closed = std::count_if(records.begin(), records.end(), [](const Record& record) { return record.meant_closed; });
  std::printf("%zu problems, %td open, %td drawn closed\n", records.size(), open, closed);
  printSuccess(records);
  std::printf(
      "\n| | CPU open, ms: p50 / p99 / most | CPU closed, ms: p50 / p99 | motion, s: p50 / p95 | to the first's, p50 "
      "| quicker by 5 %% | stops | same bits | refused | touch | found though closed |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (std::size_t m = 0; m < methods().size(); ++m) printQuality(records, m);
}

Arguments parse(int argc, char** argv) {
  Arguments arguments;
  for (int i = 1; i < argc; i += 2) {
    const std::string key = argv[i];
    if (i + 1 == argc) throw std::invalid_argument("no value for " + key);
    const std::string value = argv[i + 1];
    if (key == "--problems") {
      arguments.problems = std::stoi(value);
    } else if (key == "--seed") {
      arguments.seed = static_cast<unsigned>(std::stoul(value));
    } else if (key == "--clearance") {
      arguments.clearance = std::stod(value);
    } else if (key == "--range") {
      arguments.range = std::stod(value);
    } else {
      throw std::invalid_argument("unknown argument " + key);
    }
  }
  return arguments;
}

}  // namespace
}  // namespace parley::study

int main(int argc, char** argv) {
  try {
    const parley::study::Arguments arguments = parley::study::parse(argc, argv);
    std::vector<parley::study::Record> records;
    for (int i = 0; i < arguments.problems; ++i) {
      records.push_back(parley::study::solve(arguments.seed + static_cast<unsigned>(i), arguments));
    }
    parley::study::print(records);
    return 0;
  } catch (const std::exception& problem) {
    std::fprintf(stderr, "narrow_study: %s\n", problem.what());
    return 2;
  }
}

// SPDX-License-Identifier: BSD-3-Clause
#include "parley_sim/result.h"

#include <algorithm>
#include <cmath>

#include "parley_sim/shortest_path.h"

namespace parley::sim {
namespace {

constexpr double kDiscRadius = 0.25;  // [m] of the disc whose shortest path is the yardstick

RobotResult robotResult(const FleetRunner& runner, std::size_t index) {
  const Simulation& simulation = runner.simulation();
  const RobotSpec& spec = simulation.scenario().robots[index];
  const RobotRecord& record = simulation.referee().records()[index];
  const BrainOutput& output = runner.output(index);
  RobotResult robot;
  robot.name = spec.name;
  robot.reached = record.reached;
  robot.length = record.length;
  if (record.reached) robot.time = record.time;
  if (record.reached && record.time > 0.0) robot.mean_speed = record.length / record.time;
  robot.straight = (spec.goal - spec.start.position()).norm();
  robot.shortest = shortestLength(simulation.world(), spec.start.position(), spec.goal, kDiscRadius);
  if (std::isfinite(record.min_clearance)) robot.min_clearance = record.min_clearance;
  robot.stopped = record.stopped;
  robot.escapes = output.escapes;
  robot.replans = output.replans;
  robot.route_switches = output.route_switches;
  robot.final_state = toString(runner.state(index));
  robot.tx_bytes = simulation.radio().tx_bytes[index];
  robot.rx_bytes = simulation.radio().rx_bytes[index];
  return robot;
}

/// Mean over the robots for which `value` gives one.
template <class Value>
std::optional<double> meanOver(const std::vector<RobotResult>& robots, Value value) {
  double sum = 0.0;
  int count = 0;
  for (const RobotResult& robot : robots) {
    const std::optional<double> one = robot.reached ? value(robot) : std::nullopt;
    if (!one) continue;
    sum += *one;
    ++count;
  }
  if (count == 0) return std::nullopt;
  return sum / count;
}

std::optional<double> ratio(double a, double b) { return b > 0.0 ? std::optional<double>(a / b) : std::nullopt; }

std::optional<double> percentile(std::vector<float> seconds, double fraction) {
  if (seconds.empty()) return std::nullopt;
  const auto rank = static_cast<std::ptrdiff_t>(std::lround(fraction * static_cast<double>(seconds.size() - 1)));
  std::nth_element(seconds.begin(), seconds.begin() + rank, seconds.end());
  return 1000.0 * static_cast<double>(seconds[static_cast<std::size_t>(rank)]);
}

/// Of values of any kind, the one at a rank; nullopt if there are none.
std::optional<double> ranked(std::vector<double> values, double fraction) {
  if (values.empty()) return std::nullopt;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(std::lround(fraction * static_cast<double>(values.size() - 1)))];
}

void addLocalization(const FleetRunner& runner, Result& result) {
  const LocalizationJudge& judge = runner.localization();
  result.encounters = static_cast<int>(runner.simulation().encounters().size());
  const std::vector<double> seconds = judge.secondsToLocalize();
  result.localized = static_cast<int>(seconds.size());
  result.false_pairs = judge.falsePairs();
  std::vector<double> translations, rotations;
  for (const PoseError& error : judge.errors()) {
    translations.push_back(error.translation);
    rotations.push_back(error.rotation);
  }
  result.translation_error_p50 = ranked(translations, 0.5);
  result.translation_error_max = ranked(translations, 1.0);
  result.rotation_error_p50 = ranked(rotations, 0.5);
  result.rotation_error_max = ranked(rotations, 1.0);
  result.seconds_to_localize_p50 = ranked(seconds, 0.5);
}

void addRadio(const FleetRunner& runner, Result& result) {
  const Simulation& simulation = runner.simulation();
  const RadioCounters& radio = simulation.radio();
  std::int64_t total = 0;
  for (const std::int64_t bytes : radio.tx_bytes) total += bytes;
  const double robot_seconds = simulation.time() * static_cast<double>(radio.tx_bytes.size());
  if (robot_seconds > 0.0) result.bytes_per_second_per_robot = static_cast<double>(total) / robot_seconds;
  for (std::size_t robot = 0; robot < radio.tx_bytes.size(); ++robot) {
    const SentBytes& sent = runner.output(robot).sent;
    result.map_bytes += sent.map;
    result.keyframe_bytes += sent.keyframe;
    result.trajectory_bytes += sent.trajectory;
    result.beacon_bytes += sent.beacon;
    result.conflict_bytes += sent.conflict;
  }
  result.overhead_bytes =
      total - result.map_bytes - result.keyframe_bytes - result.trajectory_bytes - result.beacon_bytes - result.conflict_bytes;
  result.delivered = ratio(static_cast<double>(radio.received), static_cast<double>(radio.expected));
}

}  // namespace

int Result::reachedCount() const {
  return static_cast<int>(std::count_if(robots.begin(), robots.end(), [](const RobotResult& r) { return r.reached; }));
}

namespace {

IncidentResult incidentResult(const Scenario& scenario, const Incident& incident) {
  IncidentResult result;
  result.time = incident.time;
  result.kind = incident.touched                        ? "touched"
                : incident.kind == ContactKind::kStatic ? "static"
                : incident.kind == ContactKind::kRobot  ? "robot"
                                                        : "moving";
  result.robot = scenario.robots[incident.robot].name;
  if (incident.kind == ContactKind::kRobot) result.other = scenario.robots[incident.other].name;
  result.position = incident.position;
  return result;
}

}  // namespace

Result resultOf(const FleetRunner& runner, const std::string& variant, double wall) {
  const Simulation& simulation = runner.simulation();
  const Referee& referee = simulation.referee();
  Result result;
  result.scenario = simulation.scenario().name;
  result.seed = simulation.scenario().seed;
  result.variant = variant;
  result.success = referee.success();
  result.static_collisions = referee.collisions(ContactKind::kStatic);
  result.robot_collisions = referee.collisions(ContactKind::kRobot);
  result.moving_collisions = referee.collisions(ContactKind::kMoving);
  result.touched = referee.touched();
  for (std::size_t i = 0; i < simulation.scenario().robots.size(); ++i) result.robots.push_back(robotResult(runner, i));
  for (const Incident& incident : referee.incidents()) {
    result.incidents.push_back(incidentResult(simulation.scenario(), incident));
  }
  using Robot = const RobotResult&;
  result.mean_time = meanOver(result.robots, [](Robot r) { return r.time; });
  result.mean_length = meanOver(result.robots, [](Robot r) { return std::optional<double>(r.length); });
  result.path_optimality = meanOver(result.robots, [](Robot r) { return ratio(r.straight, r.length); });
  result.mean_regret = meanOver(result.robots, [](Robot r) { return r.shortest ? ratio(r.length, *r.shortest) : std::nullopt; });
  addRadio(runner, result);
  addLocalization(runner, result);
  for (std::size_t stage = 0; stage < kStageNames.size(); ++stage) {
    const std::vector<float>& seconds = runner.stageTimes()[stage];
    result.timing[stage] = {percentile(seconds, 0.5), percentile(seconds, 0.99)};
  }
  result.simulated = simulation.time();
  result.wall = wall;
  return result;
}

}  // namespace parley::sim

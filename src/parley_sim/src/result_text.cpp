// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>

#include "json_writer.h"
#include "parley_sim/result.h"

namespace parley::sim {
namespace {

void writeRobot(JsonWriter& json, const RobotResult& robot) {
  json.beginObject();
  json.text("name", robot.name);
  json.flag("reached", robot.reached);
  json.number("time", robot.time);
  json.number("length", robot.length);
  json.number("straight", robot.straight);
  json.number("shortest", robot.shortest);
  json.number("mean_speed", robot.mean_speed);
  json.number("min_clearance", robot.min_clearance);
  json.number("stopped", robot.stopped);
  json.integer("escapes", robot.escapes);
  json.integer("replans", robot.replans);
  json.integer("route_switches", robot.route_switches);
  json.text("final_state", robot.final_state);
  json.integer("tx_bytes", robot.tx_bytes);
  json.integer("rx_bytes", robot.rx_bytes);
  json.endObject();
}

void writeRadio(JsonWriter& json, const Result& result) {
  json.beginObject("radio");
  json.number("bytes_per_second_per_robot", result.bytes_per_second_per_robot);
  json.integer("map_bytes", result.map_bytes);
  json.integer("keyframe_bytes", result.keyframe_bytes);
  json.integer("trajectory_bytes", result.trajectory_bytes);
  json.integer("beacon_bytes", result.beacon_bytes);
  json.integer("conflict_bytes", result.conflict_bytes);
  json.integer("overhead_bytes", result.overhead_bytes);
  json.number("delivered", result.delivered);
  json.endObject();
}

void writeRelativeLocalization(JsonWriter& json, const Result& result) {
  json.beginObject("relative_localization");
  json.integer("encounters", result.encounters);
  json.integer("localized", result.localized);
  json.integer("false", result.false_pairs);
  json.beginObject("translation_error");
  json.number("p50", result.translation_error_p50);
  json.number("max", result.translation_error_max);
  json.endObject();
  json.beginObject("rotation_error");
  json.number("p50", result.rotation_error_p50);
  json.number("max", result.rotation_error_max);
  json.endObject();
  json.beginObject("seconds_to_localize");
  json.number("p50", result.seconds_to_localize_p50);
  json.endObject();
  json.endObject();
}

void writeIncident(JsonWriter& json, const IncidentResult& incident) {
  json.beginObject();
  json.number("time", incident.time);
  json.text("kind", incident.kind);
  json.text("robot", incident.robot);
  if (!incident.other.empty()) json.text("other", incident.other);
  json.number("x", incident.position.x());
  json.number("y", incident.position.y());
  json.endObject();
}

void writeTiming(JsonWriter& json, const Result& result) {
  json.beginObject("timing_ms");
  for (std::size_t stage = 0; stage < kStageNames.size(); ++stage) {
    json.beginObject(kStageNames[stage]);
    json.number("p50", result.timing[stage].p50);
    json.number("p99", result.timing[stage].p99);
    json.endObject();
  }
  json.endObject();
}

std::string decimals(double value, int count) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*f", count, value);
  return text.data();
}

}  // namespace

std::string toJson(const Result& result) {
  JsonWriter json;
  json.text("scenario", result.scenario);
  json.integer("seed", static_cast<std::int64_t>(result.seed));
  json.text("variant", result.variant);
  json.flag("success", result.success);
  json.beginObject("collisions");
  json.integer("static", result.static_collisions);
  json.integer("robot", result.robot_collisions);
  json.integer("moving", result.moving_collisions);
  json.endObject();
  json.integer("touched", result.touched);
  json.number("mean_time", result.mean_time);
  json.number("mean_length", result.mean_length);
  json.number("path_optimality", result.path_optimality);
  json.number("mean_regret", result.mean_regret);
  json.beginList("robots");
  for (const RobotResult& robot : result.robots) writeRobot(json, robot);
  json.endList();
  json.beginList("incidents");
  for (const IncidentResult& incident : result.incidents) writeIncident(json, incident);
  json.endList();
  writeRadio(json, result);
  writeRelativeLocalization(json, result);
  writeTiming(json, result);
  json.number("simulated", result.simulated);
  json.number("wall", result.wall);
  return json.finish();
}

std::string summaryOf(const Result& result) {
  std::string line = result.scenario + ", seed " + std::to_string(result.seed) + ", " + result.variant + ": ";
  line += result.success ? "success" : "FAILED";
  line += ", " + std::to_string(result.reachedCount()) + " of " + std::to_string(result.robots.size()) + " reached, ";
  line += std::to_string(result.collisions()) + " collisions";
  if (result.mean_time) line += ", " + decimals(*result.mean_time, 1) + " s and ";
  if (result.mean_length) line += decimals(*result.mean_length, 1) + " m on average";
  if (result.mean_regret) line += ", regret " + decimals(*result.mean_regret, 2);
  line += "; " + decimals(result.simulated, 1) + " s simulated in " + decimals(result.wall, 1) + " s";
  return line;
}

}  // namespace parley::sim

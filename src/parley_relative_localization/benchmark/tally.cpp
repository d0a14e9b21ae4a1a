// SPDX-License-Identifier: BSD-3-Clause
#include "tally.h"

#include <algorithm>
#include <cstdio>

namespace parley::study {

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5)];
}

void Tally::add(const Outcome& outcome) {
  wrong += outcome.wrong ? 1 : 0;
  steps.insert(steps.end(), outcome.step_seconds.begin(), outcome.step_seconds.end());
  descriptors.insert(descriptors.end(), outcome.descriptor_bytes.begin(), outcome.descriptor_bytes.end());
  if (!outcome.is_encounter) return;
  ++encounters;
  bytes.push_back(outcome.bytes);
  if (outcome.tentative) {
    ++tentative;
    if (isWrong(outcome.tentative_error, outcome.tentative_turn)) {
      ++tentative_wrong;
    } else {
      tentative_translation.push_back(outcome.tentative_error);
      tentative_rotation.push_back(degrees(outcome.tentative_turn));
    }
  }
  if (!outcome.confirmed) return;
  ++confirmed;
  early += outcome.travel <= 2.0 ? 1 : 0;
  translation.push_back(outcome.translation_error);
  rotation.push_back(degrees(outcome.rotation_error));
  travel.push_back(outcome.travel);
  seconds.push_back(outcome.seconds);
  consistency.push_back(outcome.consistency);
}

void Tally::addElsewhere(const Outcome& outcome) {
  ++elsewhere;
  wrong_elsewhere += outcome.confirmed ? 1 : 0;
  steps.insert(steps.end(), outcome.step_seconds.begin(), outcome.step_seconds.end());
}

void Tally::printHead() {
  std::printf(
      "world                  enc  conf  share  tent  <=2m  wrong else wrong  m p50  p95   deg p50 p95   travel sec    byte desc "
      "  ms p50 p99  chi  tentative wrong\n");
}

void Tally::print(const std::string& name) const {
  std::printf(
      "%-20s %5d %5d %5.1f%% %5.1f%% %5.1f%% %4d %5d %4d  %5.3f %5.3f  %5.2f %5.2f  %5.2f %5.2f  %4.0f %4.0f  %5.2f %5.2f %4.1f "
      "%4d\n",
      name.c_str(), encounters, confirmed, 100.0 * confirmed / std::max(encounters, 1),
      100.0 * tentative / std::max(encounters, 1), 100.0 * early / std::max(confirmed, 1), wrong, elsewhere, wrong_elsewhere,
      quantile(translation, 0.5), quantile(translation, 0.95), quantile(rotation, 0.5), quantile(rotation, 0.95),
      quantile(travel, 0.5), quantile(seconds, 0.5), quantile(bytes, 0.5), quantile(descriptors, 0.5), 1e3 * quantile(steps, 0.5),
      1e3 * quantile(steps, 0.99), quantile(consistency, 0.5), tentative_wrong);
  std::fflush(stdout);
}

std::string Tally::json() const {
  char text[1400];
  std::snprintf(
      text, sizeof(text),
      "{\"encounters\": %d, \"confirmed\": %d, \"tentative\": %d, \"within_two_metres\": %d, \"wrong\": %d, \"elsewhere\": %d, "
      "\"wrong_elsewhere\": %d, \"translation_error\": {\"p50\": %.4f, \"p95\": %.4f}, \"rotation_error_degrees\": "
      "{\"p50\": %.3f, \"p95\": %.3f}, \"joint_travel\": {\"p50\": %.2f}, \"seconds\": {\"p50\": %.2f}, "
      "\"bytes\": {\"p50\": %.0f, \"p95\": %.0f}, \"descriptor_bytes\": {\"p50\": %.0f, \"p99\": %.0f}, "
      "\"match_ms\": {\"p50\": %.3f, \"p99\": %.3f}, \"consistency\": {\"p50\": %.2f, \"p95\": %.2f}, "
      "\"tentative_wrong\": %d, \"tentative_right\": {\"translation_p50\": %.4f, \"translation_p95\": %.4f, "
      "\"rotation_p50_degrees\": %.3f, \"rotation_p95_degrees\": %.3f}}",
      encounters, confirmed, tentative, early, wrong, elsewhere, wrong_elsewhere, quantile(translation, 0.5),
      quantile(translation, 0.95), quantile(rotation, 0.5), quantile(rotation, 0.95), quantile(travel, 0.5),
      quantile(seconds, 0.5), quantile(bytes, 0.5), quantile(bytes, 0.95), quantile(descriptors, 0.5),
      quantile(descriptors, 0.99), 1e3 * quantile(steps, 0.5), 1e3 * quantile(steps, 0.99), quantile(consistency, 0.5),
      quantile(consistency, 0.95), tentative_wrong, quantile(tentative_translation, 0.5), quantile(tentative_translation, 0.95),
      quantile(tentative_rotation, 0.5), quantile(tentative_rotation, 0.95));
  return text;
}

}  // namespace parley::study

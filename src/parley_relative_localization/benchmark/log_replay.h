// SPDX-License-Identifier: BSD-3-Clause
// Stretches of a real log as robots that are there at the same time.
#pragma once

#include <optional>

#include "log_meetings.h"
#include "study.h"

namespace parley::study {

struct ReplayOptions {
  StudyOptions study;
  bool paint = true;         // bodies in each other's ranges; else surfaces alone
  bool scans_alone = false;  // only the log's own scans, one to two a second, instead of views from the places between
};

/// Two stretches that pass the same place. Half of them drive one stretch back; robots nearer than 1.6 m back off.
std::optional<Outcome> replayEncounter(const CarmenLog& log, const std::vector<Meeting>& meetings, const ReplayOptions& options,
                                       unsigned seed);

/// Two stretches far from each other, that hear each other. Each meets a third and a fourth that say nothing.
std::optional<Outcome> replayElsewhere(const CarmenLog& log, const std::vector<Meeting>& meetings, const ReplayOptions& options,
                                       unsigned seed);

}  // namespace parley::study

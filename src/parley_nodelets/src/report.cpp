// SPDX-License-Identifier: BSD-3-Clause
#include "parley_nodelets/report.h"

namespace parley {
namespace {

constexpr double kOld = 1.0;  // [s]

}  // namespace

void reportOdometry(Report& report, const OdometrySnapshot& odometry, const Frames& frames, double now) {
  const OdometryCounters& counters = odometry.counters;
  report.add("odometry received", counters.received);
  report.add("odometry in other frames", counters.wrong_frame);
  report.add("odometry malformed", counters.malformed);
  report.add("odometry out of order", counters.out_of_order);
  report.add("odometry jumps", counters.jumps);
  report.add("time resets", counters.time_resets);
  if (counters.wrong_frame > 0) {
    report.mergeSummaryf(Report::WARN, "odometry is not from %s to %s", frames.local.c_str(), frames.base.c_str());
  }
  if (odometry.buffer.empty()) {
    report.mergeSummary(Report::WARN, "no odometry");
  } else if (now - odometry.buffer.latest().stamp > kOld) {
    report.mergeSummary(Report::WARN, "odometry is old");
  }
}

}  // namespace parley

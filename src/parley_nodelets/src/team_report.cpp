// SPDX-License-Identifier: BSD-3-Clause
#include "parley_nodelets/team_node.h"

namespace parley {

void TeamNode::report(Report& report) {
  report.summary(Report::OK, "");
  if (!team_) {
    report.summary(Report::ERROR, "could not join anew");
    return;
  }
  std::map<PoseState, int> count;
  for (const auto& [id, teammate] : team_->teammates()) ++count[teammate.estimate.state];
  for (const PoseState state : {PoseState::kUnknown, PoseState::kCandidate, PoseState::kTentative, PoseState::kConfirmed}) {
    report.add(std::string("peers ") + toString(state), count[state]);
  }
  const RelativeLocalizationCounters localization = team_->localizationCounters();
  report.add("scan matches", localization.matches);
  report.add("poses contradicted", localization.demotions);
  report.add("inputs of localization refused", localization.refused);
  report.add("maps of peers drawn", layers_.size());
  report.add("messages rejected", rejected_);
  report.add("exceptions", worker_.errors());
  reportOdometry(report, odometry_.read(), config_.node.frames, ros::Time::now().toSec());
}

void TeamNode::reportRadio(Report& report) {
  report.summary(Report::OK, "");
  if (!team_) return;
  const double now = ros::Time::now().toSec();
  const ExchangeCounters& counters = team_->exchange().counters();
  const double passed = now - reported_at_;
  report.add("sent [byte/s]", passed > 0.0 ? static_cast<double>(counters.bytes_sent - reported_bytes_) / passed : 0.0);
  reported_at_ = now;
  reported_bytes_ = counters.bytes_sent;
  report.add("packets sent", counters.packets_sent);
  report.add("packets received", counters.packets_received);
  report.add("packets accepted", counters.packets_accepted);
  report.add("dropped: own", counters.dropped_own);
  report.add("dropped: no packet of this version", counters.dropped_format);
  report.add("dropped: another key or forged", counters.dropped_authentication);
  report.add("dropped: from before the sender's start", counters.dropped_boot);
  report.add("dropped: seen before", counters.dropped_replay);
  report.add("dropped: sender too busy", counters.dropped_rate);
  report.add("dropped: too many robots", counters.dropped_table);
  report.add("dropped: not taken in time", radio_.overflows());
  report.add("implausible", counters.implausible);
  report.add("records refused", counters.records_refused);
  report.add("transport failures", radio_.failures());
  if (!radio_.problem().empty()) report.mergeSummary(Report::WARN, radio_.problem());
  if (counters.dropped_authentication > 0) report.mergeSummary(Report::WARN, "somebody uses another key");
}

}  // namespace parley

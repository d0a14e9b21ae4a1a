// SPDX-License-Identifier: BSD-3-Clause
#include "parley_relative_localization/relative_localization.h"

#include <stdexcept>
#include <utility>

#include "input_check.h"
#include "localization_core.h"

namespace parley {
namespace {

void checkConfiguration(const RelativeLocalizationOptions& options, const std::string& name, const Footprint& footprint) {
  std::string problems;
  for (const std::string& problem : checkOptions(options, "relative localization")) problems += problem + "\n";
  if (name.empty()) problems += "relative localization: a robot needs a name\n";
  if (!isPlausible(footprint)) problems += "relative localization: no robot has this footprint\n";
  if (!problems.empty()) throw std::invalid_argument(problems);
}

}  // namespace

const char* toString(PoseState state) {
  constexpr const char* kNames[] = {"unknown", "candidate", "tentative", "confirmed"};
  return kNames[static_cast<int>(state)];
}

RelativeLocalization::RelativeLocalization(const RelativeLocalizationOptions& options, std::string name,
                                           const Footprint& footprint) {
  checkConfiguration(options, name, footprint);
  core_ = std::make_unique<Core>(options, std::move(name), footprint);
}

RelativeLocalization::~RelativeLocalization() = default;
RelativeLocalization::RelativeLocalization(RelativeLocalization&&) noexcept = default;
RelativeLocalization& RelativeLocalization::operator=(RelativeLocalization&&) noexcept = default;

void RelativeLocalization::addOwnScan(const Pose2& T_odom_base, const ObstacleScan& scan) {
  if (!isPlausible(T_odom_base) || !isPlausible(scan) || !core_->own.add(T_odom_base, scan)) ++core_->counters.refused;
}

void RelativeLocalization::addPeerMotion(const std::string& peer, const MotionReport& motion) {
  if (!isPlausible(motion)) {
    ++core_->counters.refused;
  } else if (PeerLocalizer* localizer = core_->peer(peer)) {
    localizer->addMotion(motion);
  }
}

void RelativeLocalization::addPeerSights(const std::string& peer, const SightReport& report) {
  if (!isPlausible(report)) {
    ++core_->counters.refused;
  } else if (PeerLocalizer* localizer = core_->peer(peer)) {
    localizer->addSights(report);
  }
}

void RelativeLocalization::addPeerKeyframe(const std::string& peer, const Keyframe& keyframe) {
  const auto scan = isPlausible(keyframe) ? decodeScan(keyframe.descriptor) : std::nullopt;
  if (!scan) {
    ++core_->counters.refused;
  } else if (PeerLocalizer* localizer = core_->peer(peer)) {
    localizer->addKeyframe(keyframe.id, keyframe.stamp, keyframe.T_odom_scan, *scan);
  }
}

void RelativeLocalization::addEdge(const RelativeEdge& edge) {
  if (!isPlausible(edge)) {
    ++core_->counters.refused;
  } else {
    core_->addEdge(edge);
  }
}

std::vector<PeerEstimate> RelativeLocalization::step(double now) { return core_->step(now); }

std::vector<Keyframe> RelativeLocalization::keyframes() const {
  return core_->own.keyframes(static_cast<std::size_t>(core_->options.sent_keyframes));
}

std::vector<SightReport> RelativeLocalization::sights(double since) const {
  return core_->own.reports(since, static_cast<std::size_t>(core_->options.max_reports));
}

std::vector<RelativeEdge> RelativeLocalization::edges() const {
  std::vector<RelativeEdge> own_edges;
  for (const RelativeEdge& edge : core_->graph.edges()) {
    if (edge.from == core_->name) own_edges.push_back(edge);
  }
  return own_edges;
}

RelativeLocalizationCounters RelativeLocalization::counters() const { return core_->counters; }

double RelativeLocalization::travel() const { return core_->own.view().travel; }

void RelativeLocalization::forget(const std::string& peer) { core_->forget(peer); }

void RelativeLocalization::reset() { core_ = std::make_unique<Core>(core_->options, core_->name, core_->footprint); }

}  // namespace parley

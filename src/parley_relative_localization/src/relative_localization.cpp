// SPDX-License-Identifier: BSD-3-Clause
#include "parley_relative_localization/relative_localization.h"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <utility>

#include "input_check.h"
#include "own_recorder.h"
#include "peer_localizer.h"

namespace parley {
namespace {

constexpr double kSamePlace = 0.6;  // [m] two robots are never nearer to each other than this

void checkConfiguration(const RelativeLocalizationOptions& options, const std::string& name, const Footprint& footprint) {
  std::string problems;
  for (const std::string& problem : checkOptions(options, "relative localization")) problems += problem + "\n";
  if (name.empty()) problems += "relative localization: a robot needs a name\n";
  if (!isPlausible(footprint)) problems += "relative localization: no robot has this footprint\n";
  if (!problems.empty()) throw std::invalid_argument(problems);
}

}  // namespace

const char* toString(PeerState state) {
  constexpr const char* kNames[] = {"unknown", "candidate", "tentative", "confirmed"};
  return kNames[static_cast<int>(state)];
}

class RelativeLocalization::Core {
 public:
  Core(const RelativeLocalizationOptions& options, std::string name, const Footprint& footprint)
      : options(options), name(std::move(name)), footprint(footprint), own(options, footprint) {}

  /// nullptr where there are too many.
  PeerLocalizer* peer(const std::string& peer_name) {
    const auto known = peers.find(peer_name);
    if (known != peers.end()) return &known->second;
    if (peer_name.empty() || peer_name == name || peers.size() >= static_cast<std::size_t>(options.max_peers)) {
      ++counters.refused_peers;
      return nullptr;
    }
    return &peers.emplace(peer_name, PeerLocalizer(options, peer_name)).first->second;
  }

  /// Another peer that is at least as well supported claims the place.
  bool isBlocked(const PeerLocalizer& one, double now) const {
    const auto wanted = one.claim(now);
    if (!wanted) return false;
    return std::any_of(peers.begin(), peers.end(), [&](const auto& entry) {
      const auto other = entry.first == one.name() ? std::nullopt : entry.second.claim(now);
      return other && (other->place - wanted->place).norm() < kSamePlace &&
             (other->confirmed || other->score > options.rival_share * wanted->score);
    });
  }

  std::vector<PeerEstimate> step(double now) {
    own.forgetBefore(now - options.sight_window - 2.0);
    own.refresh();
    for (auto& entry : peers) entry.second.weigh(now, own.view(), counters);
    std::vector<PeerEstimate> estimates;
    for (auto& entry : peers) {
      entry.second.judge(now, own.view(), isBlocked(entry.second, now), counters);
      estimates.push_back(entry.second.estimate(now, own.view()));
    }
    return estimates;
  }

  RelativeLocalizationOptions options;
  std::string name;
  Footprint footprint;
  OwnRecorder own;
  std::map<std::string, PeerLocalizer> peers;
  RelativeLocalizationCounters counters;
};

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
  if (!isPlausible(edge)) ++core_->counters.refused;
}

std::vector<PeerEstimate> RelativeLocalization::step(double now) { return core_->step(now); }

std::vector<Keyframe> RelativeLocalization::keyframes() const {
  return core_->own.keyframes(static_cast<std::size_t>(core_->options.sent_keyframes));
}

std::vector<SightReport> RelativeLocalization::sights(double since) const {
  return core_->own.reports(since, static_cast<std::size_t>(core_->options.max_reports));
}

std::vector<RelativeEdge> RelativeLocalization::edges() const {
  std::vector<RelativeEdge> edges;
  for (const auto& entry : core_->peers) {
    if (const auto edge = entry.second.edge(core_->name, core_->own.view())) edges.push_back(*edge);
  }
  return edges;
}

RelativeLocalizationCounters RelativeLocalization::counters() const { return core_->counters; }

void RelativeLocalization::forget(const std::string& peer) { core_->peers.erase(peer); }

void RelativeLocalization::reset() { core_ = std::make_unique<Core>(core_->options, core_->name, core_->footprint); }

}  // namespace parley

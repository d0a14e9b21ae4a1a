// SPDX-License-Identifier: BSD-3-Clause
#include "localization_core.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "global_search.h"

namespace parley {
namespace {

constexpr double kSamePlace = 0.6;    // [m] two robots are never nearer to each other than this
constexpr double kOverlap = 0.35;     // [m] and never at all so near
constexpr double kOverlapStep = 0.2;  // [s]
constexpr double kDoubtful = 3.0;     // [s] after another claimed the same place, a peer is not confirmed there
constexpr double kSolvePeriod = 0.5;  // [s]
constexpr double kElsewhere = 25.0;   // [-] squared deviations from which on two estimates are of different places

/// Larger of the deviations of the peer's place near this robot. [m]
double deviationAt(const PoseEstimate& estimate, const Eigen::Vector2d& place) {
  const Eigen::Matrix3d covariance = covarianceAbout(estimate, place);
  return std::sqrt(std::max(covariance(0, 0), covariance(1, 1)));
}

}  // namespace

RelativeLocalization::Core::Core(const RelativeLocalizationOptions& own_options, std::string own_name,
                                 const Footprint& own_footprint)
    : options(own_options),
      name(std::move(own_name)),
      footprint(own_footprint),
      own(own_options, own_footprint),
      graph(own_options, name) {}

PeerLocalizer* RelativeLocalization::Core::peer(const std::string& peer_name) {
  const auto known = peers.find(peer_name);
  if (known != peers.end()) return &known->second;
  if (peer_name.empty() || peer_name == name || peers.size() >= static_cast<std::size_t>(options.max_peers)) {
    ++counters.refused_peers;
    return nullptr;
  }
  return &peers.emplace(peer_name, PeerLocalizer(options, peer_name)).first->second;
}

void RelativeLocalization::Core::addEdge(const RelativeEdge& edge) {
  if (edge.from == name) return;  // this robot's own, come back
  const auto demoted = demoted_.find(edge.to == name ? edge.from : std::string());
  if (demoted == demoted_.end() || edge.stamp > demoted->second) graph.add(edge);
}

void RelativeLocalization::Core::forget(const std::string& peer_name) {
  peers.erase(peer_name);
  known_.clear();  // named anew at the next step
  graph.forget(peer_name);
  solved_.erase(peer_name);
  demoted_.erase(peer_name);
  blocked_until_.erase(peer_name);
}

/// Another peer claims the place where this one was last seen, and is not much worse supported; or a confirmed one was where
/// this one would have been; or others know it elsewhere.
bool RelativeLocalization::Core::isBlocked(double now, const PeerLocalizer& one) const {
  const SightFit* fit = one.evidence();
  const auto wanted = fit == nullptr ? std::nullopt : one.claim(fit->last);
  if (!wanted) return false;
  const bool is_claimed = std::any_of(peers.begin(), peers.end(), [&](const auto& entry) {
    const auto other = entry.first == one.name() ? std::nullopt : entry.second.claim(fit->last);
    return other && (other->place - wanted->place).norm() < kSamePlace &&
           (other->confirmed || other->score > options.rival_share * wanted->score);
  });
  return is_claimed || overlapsKnown(one, *fit) || contradictsGraph(now, one, *fit);
}

/// The way over third robots leads elsewhere. That many agreeing measurements weigh more than a look that could be at somebody
/// else, unless the look is that much better than it had to be.
bool RelativeLocalization::Core::contradictsGraph(double now, const PeerLocalizer& one, const SightFit& fit) const {
  if (one.state() == PoseState::kConfirmed || !fit.solved || one.isBeyondDoubt(fit)) return false;
  const auto known = byGraph(now, one.name());
  if (!known) return false;
  const Eigen::Vector3d step = stepBetween(known->pose, fit.pose.T_odom_peerodom, fit.center);
  const Eigen::Matrix3d covariance = covarianceAbout(*known, fit.center) + fit.covariance;
  return step.dot(covariance.ldlt().solve(step)) > kElsewhere;
}

bool RelativeLocalization::Core::overlapsKnown(const PeerLocalizer& one, const SightFit& fit) const {
  for (double stamp = fit.first; stamp <= fit.last; stamp += kOverlapStep) {
    const auto place = one.placeAt(stamp, fit.pose);
    if (!place) continue;
    const std::string known = whoWasAt(stamp, *place, kOverlap);
    if (!known.empty() && known != one.name()) return true;
  }
  return false;
}

/// The confirmed peer nearest to a place [m] in own odom at a time of the own clock [s], `reach` [m] at most; empty if none.
std::string RelativeLocalization::Core::whoWasAt(double stamp, const Eigen::Vector2d& place, double reach) const {
  std::string nearest;
  double least = reach;
  for (const PeerEstimate& estimate : known_) {
    const auto there = peers.at(estimate.peer).placeAt(stamp, {estimate.T_odom_peerodom.pose, estimate.time_offset});
    if (!there || (*there - place).norm() >= least) continue;
    least = (*there - place).norm();
    nearest = estimate.peer;
  }
  return nearest;
}

/// One global search at a time, for the peer that has waited longest.
void RelativeLocalization::Core::searchForOne(double now) {
  if (!options.global_search || now - last_search_ < options.search_period || own.view().surfaces.empty()) return;
  PeerLocalizer* chosen = nullptr;
  for (auto& entry : peers) {
    const bool is_waiting = entry.second.surfacesToSearch(own.view()) != nullptr;
    if (is_waiting && (chosen == nullptr || entry.second.lastSearch() < chosen->lastSearch())) chosen = &entry.second;
  }
  if (chosen == nullptr) return;
  last_search_ = now;
  ++counters.global_searches;
  const auto found = searchGlobally(own.view().surfaces.map(), *chosen->surfacesToSearch(own.view()), options);
  chosen->setSearched(now, found ? std::optional<Pose2>(found->pose) : std::nullopt, own.view());
}

void RelativeLocalization::Core::updateGraph(double now) {
  bool is_new = false;
  for (const auto& entry : peers) {
    const auto edge = entry.second.edge(name, own.view());
    if (!edge) continue;
    graph.add(*edge);
    is_new = is_new || solved_.count(entry.first) == 0;
  }
  if (own.view().side.motion.empty() || !graph.changed() || (!is_new && now - last_solved_ < kSolvePeriod)) return;
  solved_ = graph.solve({own.view().side.motion.latest().pose, own.view().travel});
  solved_travel_ = own.view().travel;
  last_solved_ = now;
}

std::optional<Pose2> RelativeLocalization::Core::knownFrame(const std::string& peer_name) const {
  const auto solved = solved_.find(peer_name);
  return solved == solved_.end() ? std::nullopt : std::optional<Pose2>(solved->second.T_odom_peerodom.pose);
}

/// What all edges say of a peer by now; nullopt if that is too old or too little.
std::optional<PoseEstimate> RelativeLocalization::Core::byGraph(double now, const std::string& peer_name) const {
  const auto solved = solved_.find(peer_name);
  if (solved == solved_.end() || own.view().side.motion.empty()) return std::nullopt;
  const GraphEstimate& known = solved->second;
  const auto localizer = peers.find(peer_name);
  const double peer_way = localizer == peers.end() ? 0.0 : std::max(localizer->second.travel() - known.travel, 0.0);
  const Eigen::Vector2d here = own.view().side.motion.latest().pose.position();
  PoseEstimate grown = known.T_odom_peerodom;
  const double way = peer_way + own.view().travel - solved_travel_;
  grown.covariance += covarianceOfPose(grown.pose, here, driftOver(way, options));
  if (deviationAt(grown, here) > options.expire_deviation || now - known.stamp > options.expire_age) return std::nullopt;
  return grown;
}

/// The graph's answer where it is better than, or there is no, measurement of this robot's own.
void RelativeLocalization::Core::mergeGraph(double now, const std::string& peer_name, PeerEstimate& estimate) const {
  const auto grown = byGraph(now, peer_name);
  if (!grown) return;
  const Eigen::Vector2d here = own.view().side.motion.latest().pose.position();
  const bool is_direct = estimate.state == PoseState::kConfirmed;
  if (is_direct && deviationAt(*grown, here) >= deviationAt(estimate.T_odom_peerodom, here)) return;
  estimate.T_odom_peerodom = *grown;
  if (is_direct) return;
  estimate.state = PoseState::kConfirmed;
  estimate.direct = false;
  estimate.age = std::max(now - solved_.at(peer_name).stamp, 0.0);
  estimate.support = solved_.at(peer_name).edges;
}

/// What is seen where a confirmed peer is, is that peer and no other. Robots that start alike in a building that is alike on
/// both sides are taken for each other otherwise.
void RelativeLocalization::Core::nameBlobs(const std::vector<PeerEstimate>& estimates) {
  known_.clear();
  std::copy_if(estimates.begin(), estimates.end(), std::back_inserter(known_), [&](const PeerEstimate& estimate) {
    return estimate.state == PoseState::kConfirmed && peers.count(estimate.peer) > 0;
  });
  own.nameBlobs([&](double stamp, const Eigen::Vector2d& place) { return whoWasAt(stamp, place, kBody); });
}

std::vector<PeerEstimate> RelativeLocalization::Core::step(double now) {
  own.forgetBefore(now - options.sight_window - 2.0);
  if (!peers.empty()) own.refresh();
  for (auto& entry : peers) entry.second.weigh(now, own.view(), knownFrame(entry.first), counters);
  searchForOne(now);
  std::map<std::string, PeerEstimate> estimates;
  for (auto& entry : peers) {
    const long demotions = counters.demotions;
    if (isBlocked(now, entry.second)) blocked_until_[entry.first] = now + kDoubtful;
    const auto blocked = blocked_until_.find(entry.first);
    entry.second.judge(now, own.view(), blocked != blocked_until_.end() && now < blocked->second, counters);
    if (counters.demotions > demotions) {
      graph.forget(entry.first);
      solved_.erase(entry.first);
      demoted_[entry.first] = now;
    }
    estimates[entry.first] = entry.second.estimate(now, own.view());
  }
  updateGraph(now);
  for (const auto& solved : solved_) estimates[solved.first].peer = solved.first;
  std::vector<PeerEstimate> result;
  for (auto& entry : estimates) {
    mergeGraph(now, entry.first, entry.second);
    result.push_back(entry.second);
  }
  nameBlobs(result);
  return result;
}

}  // namespace parley

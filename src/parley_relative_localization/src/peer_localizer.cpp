// SPDX-License-Identifier: BSD-3-Clause
#include "peer_localizer.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

namespace parley {
namespace {

constexpr double kWeighPeriod = 0.2;        // [s] own scans alone are reason enough after this time
constexpr double kConfirmedPeriod = 0.4;    // [s] a confirmed pose is weighed no more often
constexpr double kTentativeMemory = 30.0;   // [s] without new evidence, what is not confirmed is forgotten
constexpr double kClaimStays = 1.0;         // [s] after the last sighting a place is still claimed
constexpr double kBlindFactor = 2.0;        // [-] where surfaces say nothing, sightings must say so much more
constexpr double kBlindResidual = 0.7;      // [-] and leave so small a share of the residuals
constexpr double kBeyondDoubt = 2.0;        // [-] so many times what confirms is believed against what others say
constexpr double kReason = 16.0;            // [-] squared deviations that a held pose is moved by at most
constexpr int kMostChecks = 3;              // [-] hypotheses whose surfaces are compared at a time
constexpr double kSearchedDeviation = 0.1;  // [m] of a pose that surfaces alone gave
constexpr double kSearchedRotation = 0.03;  // [rad]

}  // namespace

PeerLocalizer::PeerLocalizer(const RelativeLocalizationOptions& options, std::string name)
    : options_(options), name_(std::move(name)), hypotheses_(options) {
  side_.name = name_;
}

void PeerLocalizer::addMotion(const MotionReport& motion) {
  side_.footprint = motion.footprint;
  if (side_.motion.empty() || motion.stamp >= side_.motion.latest().stamp) travel_ = motion.travel;
  sight_motion_.add(motion, side_);
  changed_ = true;
}

void PeerLocalizer::addSights(const SightReport& report) {
  const auto is_same = [&](const SightRecord& other) { return std::abs(other.stamp - report.stamp) < 1e-3; };
  if (std::any_of(side_.sights.begin(), side_.sights.end(), is_same)) return;
  SightRecord record;
  record.stamp = report.stamp;
  record.T_odom_scan = report.T_odom_scan;
  record.blobs = report.blobs;
  side_.add(std::move(record), static_cast<std::size_t>(options_.max_sights));
  sight_motion_.read(side_);
  changed_ = true;
}

void PeerLocalizer::addKeyframe(int id, double stamp, const Pose2& T_odom_scan, const PolarScan& scan) {
  const auto is_same = [&](const PlacedScan& other) { return other.id == id; };
  if (std::any_of(keyframes_.begin(), keyframes_.end(), is_same)) return;
  const auto later = [](double time, const PlacedScan& other) { return time < other.stamp; };
  keyframes_.insert(std::upper_bound(keyframes_.begin(), keyframes_.end(), stamp, later), {id, stamp, T_odom_scan, scan});
  if (keyframes_.size() > static_cast<std::size_t>(options_.peer_keyframes)) keyframes_.pop_front();
  surfaces_ = std::make_shared<SurfaceMap>(std::vector<PlacedScan>(keyframes_.begin(), keyframes_.end()));
  SightRecord record;
  record.stamp = stamp;
  record.T_odom_scan = T_odom_scan;
  record.scan = scan;
  record.has_scan = true;
  side_.add(std::move(record), static_cast<std::size_t>(options_.max_sights));
  changed_ = true;
}

bool PeerLocalizer::isDue(double now) const {
  const double since = now - last_weighed_;
  if (state_ == PoseState::kConfirmed && since < kConfirmedPeriod) return false;
  return changed_ || since >= kWeighPeriod;
}

void PeerLocalizer::weigh(double now, const OwnView& own, const std::optional<Pose2>& known,
                          RelativeLocalizationCounters& counters) {
  side_.motion.forgetBefore(now - options_.sight_window - 2.0);
  side_.forgetBefore(now - options_.sight_window);
  if (!isDue(now)) return;
  if (own.side.sights.empty() || side_.motion.empty()) return;
  last_weighed_ = now;
  changed_ = false;
  const Eigen::Vector2d here = own.side.sights.back().T_odom_scan.position();
  if (held_) {
    hypotheses_.suggest(held_->T_odom_peerodom.pose, here, false);
  } else if (known) {
    hypotheses_.suggest(*known, here, false);
  }
  hypotheses_.propose(own.side, side_, newest_used_);
  if (!side_.sights.empty()) newest_used_ = std::max(newest_used_, side_.sights.back().stamp);
  hypotheses_.weigh(own.side, side_);
  verdict_ = checkBest(own, counters);
}

SurfaceVerdict PeerLocalizer::checkBest(const OwnView& own, RelativeLocalizationCounters& counters) {
  if (own.surfaces.empty() || !surfaces_) return {};
  for (int checked = 0; checked < kMostChecks && !hypotheses_.empty() && hypotheses_.best().fit.isMutual(2, 2); ++checked) {
    const SightFit fit = hypotheses_.best().fit;
    ++counters.matches;
    const PoseInformation pose{fit.pose.T_odom_peerodom, fit.center, fit.covariance.inverse()};
    SurfaceVerdict verdict = checkSurfaces(own.surfaces.map(), *surfaces_, pose, options_);
    if (hypotheses_.best().remembered) surface_contradictions_ = verdict.contradicts ? surface_contradictions_ + 1 : 0;
    if (verdict.contradicts) {
      hypotheses_.dropBest();
      continue;
    }
    if (verdict.agrees) {
      const SightFit fused = fitSights(own.side, side_, fit.pose, verdict.estimate, options_);
      if (fused.solved) hypotheses_.replaceBest(fused);
    }
    return verdict;
  }
  return {};
}

bool PeerLocalizer::isGood(const SightFit& fit) const {
  const double deviation = std::sqrt(std::max(fit.covariance(0, 0), fit.covariance(1, 1)));
  return fit.solved && fit.contradictions == 0 && fit.residual <= options_.confirm_residual &&
         deviation <= options_.confirm_deviation && std::sqrt(fit.covariance(2, 2)) <= options_.confirm_rotation;
}

bool PeerLocalizer::isConfirmable(const SightFit& fit) const {
  if (!isGood(fit) || !fit.isMutual(options_.confirm_own_sights, options_.confirm_peer_sights)) return false;
  if (fit.span() < options_.confirm_span) return false;
  if (hypotheses_.hasRival() || !verdict_.asked || verdict_.objects) return false;
  if (!verdict_.agrees && fit.residual > kBlindResidual * options_.confirm_residual) return false;
  const double factor = verdict_.agrees ? (verdict_.observed ? 0.5 : 1.0) : kBlindFactor;
  return fit.travel >= options_.confirm_travel && fit.distinction >= options_.confirm_distinction * factor;
}

bool PeerLocalizer::isBeyondDoubt(const SightFit& fit) const {
  return isConfirmable(fit) && verdict_.agrees && verdict_.observed && fit.travel >= kBeyondDoubt * options_.confirm_travel &&
         fit.distinction >= kBeyondDoubt * options_.confirm_distinction;
}

bool PeerLocalizer::isImprovement(const SightFit& fit, const OwnView& own) const {
  const Eigen::Vector3d step = stepBetween(held_->T_odom_peerodom.pose, fit.pose.T_odom_peerodom, fit.center);
  const Eigen::Matrix3d covariance = covarianceAbout(grown(own), fit.center) + fit.covariance;
  const Eigen::Matrix3d held = covarianceAbout(grown(own), fit.center);
  // What was known better is not given up for a look that says less, as at a robot that stands close by.
  const bool is_better =
      fit.covariance(2, 2) <= held(2, 2) && fit.covariance.topLeftCorner<2, 2>().trace() <= held.topLeftCorner<2, 2>().trace();
  return is_better && step.dot(covariance.inverse() * step) < kReason;
}

void PeerLocalizer::hold(PoseState state, const SightFit& fit, const OwnView& own) {
  const Pose2& T = fit.pose.T_odom_peerodom;
  HeldPose held;
  held.stamp = fit.solved ? fit.last : own.side.sights.back().stamp;
  held.time_offset = fit.pose.time_offset;
  const double peer_stamp = held.stamp + held.time_offset;
  held.own_travel = own.travel - own.side.motion.travel(held.stamp, own.side.motion.latest().stamp);
  held.peer_travel = travel_ - side_.motion.travel(peer_stamp, std::max(peer_stamp, side_.motion.latest().stamp));
  held.support = fit.own_sights + fit.peer_sights + hypotheses_.best().surface_matches;
  const Eigen::Vector3d searched(kSearchedDeviation, kSearchedDeviation, kSearchedRotation);
  const Eigen::Matrix3d covariance = fit.solved ? fit.covariance : Eigen::Matrix3d(searched.cwiseAbs2().asDiagonal());
  const Eigen::Vector2d center = fit.solved ? fit.center : own.side.sights.back().T_odom_scan.position();
  held.T_odom_peerodom = {T, covarianceOfPose(T, center, covariance)};
  held_ = held;
  state_ = state;
}

void PeerLocalizer::judge(double now, const OwnView& own, bool blocked, RelativeLocalizationCounters& counters) {
  if (held_) {
    const double age = now - held_->stamp;
    const bool is_confirmed = state_ == PoseState::kConfirmed;
    if (age > (is_confirmed ? options_.expire_age : kTentativeMemory)) {
      held_.reset();
      state_ = PoseState::kUnknown;
    } else if (is_confirmed) {
      const Eigen::Vector2d here =
          own.side.sights.empty() ? Eigen::Vector2d(0.0, 0.0) : own.side.sights.back().T_odom_scan.position();
      const Eigen::Matrix3d covariance = covarianceAbout(grown(own), here);
      if (std::sqrt(std::max(covariance(0, 0), covariance(1, 1))) > options_.expire_deviation) state_ = PoseState::kTentative;
    }
  }
  if (last_weighed_ == now) reconsider(own, blocked, counters);
}

void PeerLocalizer::reconsider(const OwnView& own, bool blocked, RelativeLocalizationCounters& counters) {
  const int contradictions = std::max(hypotheses_.rememberedContradictions(), surface_contradictions_);
  if (state_ == PoseState::kConfirmed && contradictions >= options_.demote_contradictions) {
    state_ = PoseState::kCandidate;
    surface_contradictions_ = 0;
    ++counters.demotions;
    return;
  }
  if (hypotheses_.empty()) return;
  const SightFit& fit = hypotheses_.best().fit;
  const bool is_confirmable = !blocked && isConfirmable(fit);
  if (state_ == PoseState::kConfirmed) {
    const bool is_alike = isAlike(held_->T_odom_peerodom.pose, fit.pose.T_odom_peerodom, fit.center);
    if (is_confirmable && !is_alike) {  // the world says otherwise now
      ++counters.demotions;
      hold(PoseState::kTentative, fit, own);
    } else if (is_alike && isGood(fit) && fit.isMutual(3, 3) && verdict_.agrees && isImprovement(fit, own)) {
      hold(PoseState::kConfirmed, fit, own);
    }
    return;
  }
  const bool is_seen = fit.isMutual(2, 2) && !hypotheses_.hasRival() && !blocked;
  if (is_confirmable) {
    hold(PoseState::kConfirmed, fit, own);
  } else if (fit.contradictions == 0 && (is_seen || hypotheses_.best().surface_matches >= 2)) {
    hold(PoseState::kTentative, fit, own);
  } else if (fit.isMutual(1, 1) && state_ != PoseState::kTentative) {
    hold(PoseState::kCandidate, fit, own);
  }
}

PoseEstimate PeerLocalizer::grown(const OwnView& own) const {
  PoseEstimate estimate = held_->T_odom_peerodom;
  const double way = std::max(own.travel - held_->own_travel, 0.0) + std::max(travel_ - held_->peer_travel, 0.0);
  const double spread = options_.drift_translation * options_.drift_translation * way;
  // A heading error acts over the way driven since, about the place where it arose.
  const double turn = options_.drift_rotation * options_.drift_rotation * way;
  const Eigen::Vector3d drift(spread + 0.25 * turn * way * way, spread + 0.25 * turn * way * way, turn);
  const Eigen::Vector2d here =
      own.side.sights.empty() ? Eigen::Vector2d(0.0, 0.0) : own.side.sights.back().T_odom_scan.position();
  estimate.covariance += covarianceOfPose(estimate.pose, here, drift.asDiagonal());
  return estimate;
}

PeerEstimate PeerLocalizer::estimate(double now, const OwnView& own) const {
  PeerEstimate result;
  result.peer = name_;
  if (!held_ || state_ == PoseState::kUnknown) return result;
  result.state = state_;
  result.T_odom_peerodom = grown(own);
  result.age = std::max(now - held_->stamp, 0.0);
  result.support = held_->support;
  result.time_offset = held_->time_offset;
  return result;
}

std::optional<Eigen::Vector2d> PeerLocalizer::placeAt(double stamp, const MeetingPose& pose) const {
  const auto motion = side_.motion.at(stamp + pose.time_offset);
  if (!motion) return std::nullopt;
  return pose.T_odom_peerodom * motion->pose.position();
}

const SightFit* PeerLocalizer::evidence() const {
  return hypotheses_.empty() || !hypotheses_.best().fit.isMutual(2, 1) ? nullptr : &hypotheses_.best().fit;
}

std::optional<PeerLocalizer::Claim> PeerLocalizer::claim(double at) const {
  const SightFit* fit = evidence();
  if (fit == nullptr || at < fit->first || at > fit->last + kClaimStays) return std::nullopt;
  const auto place = placeAt(std::min(at, fit->last), fit->pose);
  if (!place) return std::nullopt;
  return Claim{*place, fit->score(), state_ == PoseState::kConfirmed};
}

std::shared_ptr<const SurfaceMap> PeerLocalizer::surfacesToSearch(const OwnView& own) const {
  const bool is_seen = !hypotheses_.empty() && hypotheses_.best().fit.isMutual(1, 1);
  if (is_seen || state_ == PoseState::kConfirmed || keyframes_.empty()) return nullptr;
  const bool has_moved = own.travel - searched_own_travel_ >= options_.keyframe_distance;
  return has_moved || keyframes_.back().id != searched_id_ ? surfaces_ : nullptr;
}

void PeerLocalizer::setSearched(double now, const std::optional<Pose2>& found, const OwnView& own) {
  last_search_ = now;
  searched_own_travel_ = own.travel;
  searched_id_ = keyframes_.back().id;
  if (!found || own.side.sights.empty()) return;
  hypotheses_.suggest(*found, own.side.sights.back().T_odom_scan.position(), true);
  changed_ = true;
}

std::optional<RelativeEdge> PeerLocalizer::edge(const std::string& own_name, const OwnView& own) const {
  if (state_ != PoseState::kConfirmed || !held_) return std::nullopt;
  const auto here = own.side.motion.at(held_->stamp);
  const auto there = side_.motion.at(held_->stamp + held_->time_offset);
  if (!here || !there) return std::nullopt;
  RelativeEdge edge{own_name, name_, held_->stamp, here->pose, there->pose, held_->own_travel, held_->peer_travel, {}};
  const PoseEstimate exact_back{here->pose.inverse(), Covariance3::Zero()}, exact_there{there->pose, Covariance3::Zero()};
  edge.T_from_to = compose(compose(exact_back, held_->T_odom_peerodom), exact_there);
  return edge;
}

}  // namespace parley

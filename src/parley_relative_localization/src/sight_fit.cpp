// SPDX-License-Identifier: BSD-3-Clause
#include "sight_fit.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace parley {
namespace {

constexpr int kIterations = 8;        // [-]
constexpr double kDone = 1e-4;        // [m] [rad] [s]
constexpr double kCauchy = 3.0;       // [-] errors beyond so many deviations lose weight
constexpr double kCorrelation = 2.0;  // [-] sightings that share one error
constexpr double kFloor = 0.008;      // [m] no pose is more certain than this
constexpr double kTurnFloor = 0.002;  // [rad]
constexpr double kHold = 1.0;         // [1/m^2] keeps what nothing observes where it is

struct NormalEquations {
  Eigen::Matrix4d information = Eigen::Matrix4d::Zero();
  Eigen::Vector4d gradient = Eigen::Vector4d::Zero();
};

NormalEquations equationsOf(const SightTerms& sights, const Eigen::Vector2d& center) {
  NormalEquations sum;
  for (const SightTerm& term : sights.terms) {
    Eigen::Matrix<double, 2, 4> j = Eigen::Matrix<double, 2, 4>::Zero();
    j.topLeftCorner<2, 2>().setIdentity();
    j(0, 2) = -(term.place.y() - center.y());
    j(1, 2) = term.place.x() - center.x();
    j.col(3) = term.velocity;
    const double variance = term.deviation * term.deviation;
    const double ratio = term.error.squaredNorm() / (variance * kCauchy * kCauchy);
    const double weight = term.weight / (variance * (1.0 + ratio) * kCorrelation);
    sum.information += weight * j.transpose() * j;
    sum.gradient += weight * j.transpose() * term.error;
  }
  return sum;
}

/// A place between the robots when they last saw each other.
Eigen::Vector2d centerOf(const MeetingSide& own, const MeetingSide& peer, const MeetingPose& pose) {
  Eigen::Vector2d here = own.sights.empty() ? Eigen::Vector2d(0.0, 0.0) : own.sights.back().T_odom_scan.position();
  if (peer.motion.empty()) return here;
  return 0.5 * (here + pose.T_odom_peerodom * peer.motion.latest().pose.position());
}

/// From the first to the last sighting of a kind. [s] own clock
struct Span {
  double first = std::numeric_limits<double>::max(), last = std::numeric_limits<double>::lowest();
  void add(double stamp) {
    first = std::min(first, stamp);
    last = std::max(last, stamp);
  }
};

/// How far a path is from one at constant velocity. [m]
double bendOf(const MotionHistory& motion, double from, double to) {
  const auto start = motion.at(from), middle = motion.at(0.5 * (from + to)), end = motion.at(to);
  if (!start || !middle || !end) return 0.0;
  return (middle->pose.position() - 0.5 * (start->pose.position() + end->pose.position())).norm();
}

void summarise(const MeetingSide& own, const MeetingSide& peer, const SightTerms& sights, SightFit& fit) {
  fit.contradictions = sights.contradictions;
  fit.contradictions_in_row = sights.contradictions_in_row;
  if (sights.terms.empty()) return;
  Span by_own, by_peer;
  double squares = 0.0;
  for (const SightTerm& term : sights.terms) {
    (term.own ? fit.own_sights : fit.peer_sights) += 1;
    (term.own ? by_own : by_peer).add(term.stamp);
    squares += term.error.squaredNorm() / (2.0 * term.deviation * term.deviation);
  }
  fit.residual = std::sqrt(squares / static_cast<double>(sights.terms.size()));
  fit.first = std::min(by_own.first, by_peer.first);
  fit.last = std::max(by_own.last, by_peer.last);
  const double ahead = fit.pose.time_offset;
  if (fit.own_sights > 0) fit.travel += peer.motion.travel(by_own.first + ahead, by_own.last + ahead);
  if (fit.peer_sights > 0) fit.travel += own.motion.travel(by_peer.first, by_peer.last);
  const auto own_first = own.motion.at(fit.first), own_last = own.motion.at(fit.last);
  const auto peer_first = peer.motion.at(fit.first + ahead), peer_last = peer.motion.at(fit.last + ahead);
  if (!own_first || !own_last || !peer_first || !peer_last) return;
  const Pose2& T = fit.pose.T_odom_peerodom;
  const Eigen::Vector2d before = T * peer_first->pose.position() - own_first->pose.position();
  const Eigen::Vector2d after = T * peer_last->pose.position() - own_last->pose.position();
  const double bend = std::max(bendOf(own.motion, fit.first, fit.last), bendOf(peer.motion, fit.first + ahead, fit.last + ahead));
  fit.distinction = std::max((after - before).norm(), 3.0 * bend);
}

}  // namespace

SightFit fitSights(const MeetingSide& own, const MeetingSide& peer, const MeetingPose& start,
                   const std::optional<PoseInformation>& surfaces, const RelativeLocalizationOptions& options) {
  SightFit fit;
  fit.pose = start;
  fit.center = centerOf(own, peer, start);
  const double clock_precision = 1.0 / std::max(options.time_offset_noise * options.time_offset_noise, 1e-6);
  Eigen::Matrix4d information = Eigen::Matrix4d::Zero();
  SightTerms sights;
  for (int i = 0; i < kIterations; ++i) {
    sights = agreeingSights(own, peer, fit.pose, i < 2 ? options.sight_gate : 0.6 * options.sight_gate, options);
    NormalEquations sum = equationsOf(sights, fit.center);
    sum.information(3, 3) += clock_precision;
    sum.gradient(3) += clock_precision * fit.pose.time_offset;
    if (surfaces) {
      const Eigen::Matrix3d about = informationAbout(*surfaces, fit.center);
      const Eigen::Vector3d away = stepBetween(surfaces->pose, fit.pose.T_odom_peerodom, fit.center);
      sum.information.topLeftCorner<3, 3>() += about;
      sum.gradient.head<3>() += about * away;
    }
    information = sum.information;
    sum.information.diagonal().head<3>().array() += kHold;
    const Eigen::Vector4d step = -sum.information.ldlt().solve(sum.gradient);
    if (!step.allFinite()) return fit;
    fit.pose.T_odom_peerodom = movedAbout(fit.pose.T_odom_peerodom, fit.center, step.head<3>());
    fit.pose.time_offset = std::clamp(fit.pose.time_offset + step(3), -options.max_time_offset, options.max_time_offset);
    if (i >= 3 && step.cwiseAbs().maxCoeff() < kDone) break;
  }
  sights = agreeingSights(own, peer, fit.pose, 0.6 * options.sight_gate, options);
  summarise(own, peer, sights, fit);
  information.diagonal().head<3>().array() += 1e-6;
  fit.covariance = information.inverse().topLeftCorner<3, 3>();
  fit.covariance.diagonal() += Eigen::Vector3d(kFloor * kFloor, kFloor * kFloor, kTurnFloor * kTurnFloor);
  fit.solved = fit.covariance.allFinite() && !sights.terms.empty();
  return fit;
}

}  // namespace parley

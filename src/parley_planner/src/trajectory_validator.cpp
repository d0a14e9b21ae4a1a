// SPDX-License-Identifier: BSD-3-Clause
#include "trajectory_validator.h"

#include <algorithm>
#include <cmath>

namespace parley {

namespace {

constexpr double kBucketSize = 0.5;          // [m]
constexpr double kPositionTolerance = 0.02;  // [m] at the beginning
constexpr double kYawTolerance = 0.02;       // [rad]
constexpr double kTwistTolerance = 0.05;     // [m/s] [rad/s]
constexpr double kLimitTolerance = 1.02;     // [-] rounding of times and states
constexpr double kStandingTwist = 1e-3;      // [m/s] [rad/s]
constexpr double kSlack = 0.002;             // [m] that a state may lack more than the first one already does
constexpr int kUnseenSpecks = 6;             // [cells] that rays left out and that a footprint may cover
constexpr double kSeenMargin = 0.05;         // [m] a ray must pass a place by this much to have seen it free
constexpr double kNever = 1e18;              // [s]
constexpr double kRoomIsMade = 0.5;          // [s] after it could have stopped, a robot that goes first counts on others' room
constexpr double kPeerGap = 0.04;            // [m] between two robots that keep to what they said
constexpr double kPeerSigma = 0.1;           // [m]
constexpr double kFarPeer = 0.5;             // [m] further apart than this is all the same
constexpr double kTrackGrowth = 0.15;        // [m] returns this far outside a moving thing are its own

bool finite(const TrajectoryPoint& p) {
  return p.pose.isFinite() && std::isfinite(p.time) && std::isfinite(p.twist.speed) && std::isfinite(p.twist.turn_rate);
}

}  // namespace

TrajectoryValidator::TrajectoryValidator(const Footprint& footprint, const MotionLimits& limits, double prediction_time,
                                         double track_margin)
    : footprint_(footprint), limits_(limits), prediction_time_(prediction_time), track_margin_(track_margin) {}

void TrajectoryValidator::observe(const Evidence& evidence) {
  map_ = &evidence.map;
  scan_ = &evidence.scan;
  tracks_ = &evidence.tracks;
  peers_ = evidence.peers;
  right_ = evidence.right;
  T_scan_odom_ = evidence.T_odom_scan.inverse();
  const GridFrame& frame = map_->frame;
  buckets_frame_.origin = frame.origin;
  buckets_frame_.resolution = kBucketSize;
  buckets_frame_.width = static_cast<int>(std::ceil(frame.size().x() / kBucketSize));
  buckets_frame_.height = static_cast<int>(std::ceil(frame.size().y() / kBucketSize));
  for (auto& bucket : buckets_) bucket.clear();
  buckets_.resize(static_cast<std::size_t>(buckets_frame_.width * buckets_frame_.height));
  for (int y = 0, i = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x, ++i) {
      if (map_->cells[static_cast<std::size_t>(i)] == CellState::kOccupied) addPoint(frame.centerOf({x, y}));
    }
  }
  for (std::size_t bin = 0; bin < scan_->binCount(); ++bin) {
    if (!std::isfinite(scan_->ranges[bin])) continue;
    const Eigen::Vector2d p_odom = evidence.T_odom_scan * scan_->pointAt(bin, static_cast<double>(scan_->ranges[bin]));
    const bool moves = std::any_of(tracks_->begin(), tracks_->end(), [&](const TrackedObject& track) {
      return track.moving && (track.position - p_odom).norm() < track.radius + kTrackGrowth;
    });
    if (!moves) addPoint(p_odom);
  }
}

void TrajectoryValidator::addPoint(const Eigen::Vector2d& p_odom) {
  const Eigen::Vector2i cell = buckets_frame_.cellOf(p_odom);
  if (buckets_frame_.contains(cell)) buckets_[static_cast<std::size_t>(buckets_frame_.indexOf(cell))].push_back(p_odom);
}

Verdict TrajectoryValidator::check(const SampledTrajectory& trajectory, const TrajectoryPoint& begin,
                                   const Margins& margins) const {
  if (trajectory.empty()) return {Flaw::kEmpty, begin.time};
  const Verdict motion = checkMotion(trajectory.points(), begin);
  return motion.good() ? checkPlaces(trajectory.points(), margins, kNever) : motion;
}

Verdict TrajectoryValidator::checkRest(const SampledTrajectory& trajectory, double time, const Margins& margins) const {
  if (trajectory.empty()) return {Flaw::kEmpty, time};
  if (time >= trajectory.endTime()) return {};
  const std::vector<TrajectoryPoint> points = trajectory.from(time).points();
  const double stopped = time + std::abs(points.front().twist.speed) / limits_.acceleration;
  return checkPlaces(points, margins, stopped + kRoomIsMade);
}

Verdict TrajectoryValidator::checkMotion(const std::vector<TrajectoryPoint>& points, const TrajectoryPoint& begin) const {
  for (const TrajectoryPoint& p : points) {
    if (!finite(p)) return {Flaw::kNotFinite, p.time};
  }
  const TrajectoryPoint& first = points.front();
  if ((first.pose.position() - begin.pose.position()).norm() > kPositionTolerance ||
      std::abs(angleBetween(first.pose.yaw, begin.pose.yaw)) > kYawTolerance ||
      std::abs(first.twist.speed - begin.twist.speed) > kTwistTolerance ||
      std::abs(first.twist.turn_rate - begin.twist.turn_rate) > kTwistTolerance) {
    return {Flaw::kDiscontinuous, first.time};
  }
  for (std::size_t i = 1; i < points.size(); ++i) {
    const TrajectoryPoint &a = points[i - 1], &b = points[i];
    const double dt = b.time - a.time;
    const bool fast = std::abs(b.twist.speed) > limits_.speed * kLimitTolerance ||
                      std::abs(b.twist.turn_rate) > limits_.turn_rate * kLimitTolerance;
    const bool sudden = std::abs(b.twist.speed - a.twist.speed) > limits_.acceleration * dt * kLimitTolerance + 1e-6 ||
                        std::abs(b.twist.turn_rate - a.twist.turn_rate) > limits_.turn_acceleration * dt * kLimitTolerance + 1e-6;
    // The pose must go where the twist says.
    const double driven = 0.5 * (std::abs(a.twist.speed) + std::abs(b.twist.speed)) * dt;
    const bool jumps = (b.pose.position() - a.pose.position()).norm() > driven + 1e-3;
    if (dt <= 0.0 || fast || sudden || jumps) return {Flaw::kLimits, b.time};
  }
  const Twist2& last = points.back().twist;
  const bool stands = std::abs(last.speed) < kStandingTwist && std::abs(last.turn_rate) < kStandingTwist;
  return stands ? Verdict{} : Verdict{Flaw::kDoesNotStop, points.back().time};
}

Verdict TrajectoryValidator::checkPlaces(const std::vector<TrajectoryPoint>& points, const Margins& margins,
                                         double trust_from) const {
  Verdict first;
  for (const Verdict& verdict :
       {checkObstacles(points, margins), checkUnseen(points), checkTracks(points), checkPeers(points, trust_from)}) {
    if (!verdict.good() && (first.good() || verdict.time < first.time)) first = verdict;
  }
  return first;
}

// Where the robot already is cannot be helped; it must not get worse.
Verdict TrajectoryValidator::checkObstacles(const std::vector<TrajectoryPoint>& points, const Margins& margins) const {
  const double had_room = obstacleDistance(points.front().pose) - kSlack;
  for (const TrajectoryPoint& point : points) {
    if (obstacleDistance(point.pose) < std::min(had_room, margins.at(point.twist.speed))) return {Flaw::kObstacle, point.time};
  }
  return {};
}

Verdict TrajectoryValidator::checkPeers(const std::vector<TrajectoryPoint>& points, double trust_from) const {
  const double had_peer = peerDistance(points.front(), kNever) - kSlack;
  for (const TrajectoryPoint& point : points) {
    if (peerDistance(point, trust_from) < std::min(had_peer, kPeerGap)) return {Flaw::kPeer, point.time};
  }
  return {};
}

Verdict TrajectoryValidator::checkUnseen(const std::vector<TrajectoryPoint>& points) const {
  const int had_unseen = std::max(kUnseenSpecks, unseenCells(points.front().pose));
  for (const TrajectoryPoint& point : points) {
    if (unseenCells(point.pose) > had_unseen) return {Flaw::kUnseen, point.time};
  }
  return {};
}

Verdict TrajectoryValidator::checkTracks(const std::vector<TrajectoryPoint>& points) const {
  const double had_gap = trackDistance(points.front()) - kSlack;
  for (const TrajectoryPoint& point : points) {
    if (point.time - points.front().time > prediction_time_) break;
    if (trackDistance(point) < std::min(had_gap, track_margin_)) return {Flaw::kTrack, point.time};
  }
  return {};
}

double TrajectoryValidator::peerDistance(const TrajectoryPoint& point, double trust_from) const {
  double least = 1e3;
  const Polygon rectangle = footprint_.polygonAt(point.pose);
  for (const PeerMotion& peer : peers_) {
    if (point.time > trust_from && goesBefore(right_, peer.intent.right)) continue;
    const Pose2 there = peer.trajectory.at(point.time).pose;
    const double reach = footprint_.circumscribedRadius() + peer.footprint.circumscribedRadius() + kFarPeer;
    if ((there.position() - point.pose.position()).norm() > reach) continue;
    least = std::min(least, convexDistance(rectangle, peer.footprint.polygonAt(there)) - std::min(kPeerSigma, peer.sigma));
  }
  return least;
}

double TrajectoryValidator::obstacleDistance(const Pose2& pose) const {
  const double c = std::cos(pose.yaw), s = std::sin(pose.yaw);
  const double half_length = 0.5 * footprint_.length, half_width = 0.5 * footprint_.width;
  const double reach = std::hypot(half_length, half_width) + 0.3;
  const Eigen::Vector2i low = buckets_frame_.cellOf(pose.position() - Eigen::Vector2d::Constant(reach));
  const Eigen::Vector2i high = buckets_frame_.cellOf(pose.position() + Eigen::Vector2d::Constant(reach));
  double least = 0.3 * 0.3;  // [m^2] further is all the same
  for (int y = std::max(0, low.y()); y <= std::min(buckets_frame_.height - 1, high.y()); ++y) {
    for (int x = std::max(0, low.x()); x <= std::min(buckets_frame_.width - 1, high.x()); ++x) {
      for (const Eigen::Vector2d& p : buckets_[static_cast<std::size_t>(buckets_frame_.indexOf({x, y}))]) {
        const double dx = p.x() - pose.x, dy = p.y() - pose.y;
        const double along = std::max(0.0, std::abs(c * dx + s * dy) - half_length);
        const double across = std::max(0.0, std::abs(-s * dx + c * dy) - half_width);
        least = std::min(least, along * along + across * across);
      }
    }
  }
  return std::sqrt(least);
}

double TrajectoryValidator::trackDistance(const TrajectoryPoint& point) const {
  double least = 1e3;
  const Polygon rectangle = footprint_.polygonAt(point.pose);
  for (const TrackedObject& track : *tracks_) {
    if (!track.has_moved) continue;
    const Eigen::Vector2d there = track.position + (point.time - track.stamp) * track.velocity;
    double distance = contains(rectangle, there) ? 0.0 : 1e3;
    for (std::size_t i = 0; i < rectangle.size(); ++i) {
      distance = std::min(distance, pointSegmentDistance(there, rectangle[i], rectangle[(i + 1) % rectangle.size()]));
    }
    least = std::min(least, distance - track.radius);
  }
  return least;
}

int TrajectoryValidator::unseenCells(const Pose2& pose) const {
  const GridFrame& frame = map_->frame;
  const double c = std::cos(pose.yaw), s = std::sin(pose.yaw);
  const double reach_x = 0.5 * (std::abs(c) * footprint_.length + std::abs(s) * footprint_.width);
  const double reach_y = 0.5 * (std::abs(s) * footprint_.length + std::abs(c) * footprint_.width);
  const Eigen::Vector2i low = frame.cellOf({pose.x - reach_x, pose.y - reach_y});
  const Eigen::Vector2i high = frame.cellOf({pose.x + reach_x, pose.y + reach_y});
  int count = 0;
  for (int y = low.y(); y <= high.y(); ++y) {
    for (int x = low.x(); x <= high.x(); ++x) {
      if (map_->at(Eigen::Vector2i(x, y)) != CellState::kUnknown) continue;
      const Eigen::Vector2d p = frame.centerOf({x, y});
      const double dx = p.x() - pose.x, dy = p.y() - pose.y;
      const bool under =
          std::abs(c * dx + s * dy) <= 0.5 * footprint_.length && std::abs(c * dy - s * dx) <= 0.5 * footprint_.width;
      if (under && !seenThrough(p)) ++count;
    }
  }
  return count;
}

bool TrajectoryValidator::seenThrough(const Eigen::Vector2d& p_odom) const {
  if (scan_->ranges.empty()) return false;
  const Eigen::Vector2d ray = T_scan_odom_ * p_odom - scan_->origin;
  const auto bins = static_cast<double>(scan_->binCount());
  const double turn = (std::atan2(ray.y(), ray.x()) + kPi) / (2.0 * kPi);
  const auto bin = std::min(static_cast<std::size_t>(turn * bins), scan_->binCount() - 1);
  const double range = static_cast<double>(scan_->ranges[bin]);
  if (std::isnan(range)) return false;
  return ray.norm() < std::min(range, scan_->range_max) - kSeenMargin;
}

}  // namespace parley

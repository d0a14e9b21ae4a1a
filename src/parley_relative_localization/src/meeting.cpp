// SPDX-License-Identifier: BSD-3-Clause
#include "meeting.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace parley {
namespace {

constexpr double kBehind = 0.5;       // [m] a scan that goes on this far behind a robot's centre saw through it
constexpr double kLeastRange = 0.4;   // [m] nearer robots are no blobs
constexpr double kSureMotion = 0.12;  // [m] motion less sure than this contradicts nothing

Eigen::Vector2d turned(double yaw, const Eigen::Vector2d& v) { return Pose2{0.0, 0.0, yaw} * v; }

/// The scan looks on past the middle of a robot at that place, in several bins side by side.
bool seesThrough(const PolarScan& scan, const Eigen::Vector2d& p_scan) {
  const double range = p_scan.norm();
  if (range < kLeastRange || range > scan.range_max - kBehind - 0.1) return false;
  const int middle = PolarScan::binOf(std::atan2(p_scan.y(), p_scan.x()));
  for (int bin = middle - 2; bin <= middle + 2; ++bin) {
    const int wrapped = PolarScan::wrapBin(bin);
    if (scan.isUnknown(wrapped) || scan.rangeAt(wrapped) < range + kBehind) return false;
  }
  return true;
}

struct Found {
  const SightedBlob* blob = nullptr;
  SightedBlob expected;
};

/// The blob where a body should be seen, nearest to the middle of what should face the lidar.
Found findBody(const SightRecord& sight, const MeetingSide& seen, const Pose2& T_scan_body, double gate, double chord_gate) {
  Found found;
  const Eigen::Vector2d center = T_scan_body.position();
  const bool near = std::any_of(sight.blobs.begin(), sight.blobs.end(), [&](const SightedBlob& blob) {
    return (blob.position - center).squaredNorm() < (gate + kBody) * (gate + kBody);
  });
  if (!near) return found;
  const auto expected = viewOfBody(seen.footprint, T_scan_body);
  if (!expected) return found;
  found.expected = *expected;
  double least = gate;
  for (std::size_t i = 0; i < sight.blobs.size(); ++i) {
    if (sight.isOfAnother(i, seen.name)) continue;
    const SightedBlob& blob = sight.blobs[i];
    const double distance = (blob.position - expected->position).norm();
    if (distance < least && std::abs(blob.chord - expected->chord) < chord_gate) {
      least = distance;
      found.blob = &blob;
    }
  }
  return found;
}

/// Looks from the same place at the same thing share their error.
class Novelty {
 public:
  double weigh(const Eigen::Vector2d& p_scan) {
    const double moved = (p_scan - last_).norm();
    last_ = p_scan;
    return std::clamp(moved / kNewLook, kSameLook, 1.0);
  }

 private:
  static constexpr double kNewLook = 0.12;   // [m]
  static constexpr double kSameLook = 0.05;  // [-]
  Eigen::Vector2d last_ = Eigen::Vector2d::Constant(1e6);
};

double combined(double noise, double motion) { return std::hypot(noise, motion); }

}  // namespace

void MeetingSide::add(SightRecord record, std::size_t capacity) {
  const auto later = [](double stamp, const SightRecord& other) { return stamp < other.stamp; };
  sights.insert(std::upper_bound(sights.begin(), sights.end(), record.stamp, later), std::move(record));
  if (sights.size() > capacity) sights.pop_front();
}

void MeetingSide::forgetBefore(double stamp) {
  while (!sights.empty() && sights.front().stamp < stamp) sights.pop_front();
}

SightTerms agreeingSights(const MeetingSide& own, const MeetingSide& peer, const MeetingPose& pose, double gate,
                          const RelativeLocalizationOptions& options) {
  SightTerms result;
  const Pose2 T = pose.T_odom_peerodom, T_back = T.inverse();
  Novelty own_looks, peer_looks;
  for (const SightRecord& sight : own.sights) {
    const auto motion = peer.motion.at(sight.stamp + pose.time_offset);
    if (!motion) continue;
    const Pose2 T_scan_body = sight.T_odom_scan.inverse() * T * motion->pose;
    const Found found = findBody(sight, peer, T_scan_body, gate, options.chord_gate);
    if (found.blob != nullptr) {
      const Eigen::Vector2d error = turned(sight.T_odom_scan.yaw, found.expected.position - found.blob->position);
      result.terms.push_back({true, sight.stamp, combined(options.sight_noise, motion->deviation),
                              own_looks.weigh(T_scan_body.position()), error, T * motion->pose.position(),
                              turned(T.yaw, motion->velocity)});
      result.contradictions_in_row = 0;
    } else if (sight.has_scan && motion->deviation < kSureMotion && seesThrough(sight.scan, T_scan_body.position())) {
      ++result.contradictions;
      ++result.contradictions_in_row;
    }
  }
  for (const SightRecord& sight : peer.sights) {
    const auto motion = own.motion.at(sight.stamp - pose.time_offset);
    if (!motion) continue;
    const Pose2 T_scan_body = sight.T_odom_scan.inverse() * T_back * motion->pose;
    const Found found = findBody(sight, own, T_scan_body, gate, options.chord_gate);
    if (found.blob != nullptr) {
      const Eigen::Vector2d error = turned(T.yaw + sight.T_odom_scan.yaw, found.blob->position - found.expected.position);
      result.terms.push_back({false, sight.stamp - pose.time_offset, combined(options.sight_noise, motion->deviation),
                              peer_looks.weigh(T_scan_body.position()), error, T * (sight.T_odom_scan * found.blob->position),
                              motion->velocity});
    } else if (sight.has_scan && seesThrough(sight.scan, T_scan_body.position())) {
      ++result.contradictions;
    }
  }
  return result;
}

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#include "own_recorder.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace parley {

OwnRecorder::OwnRecorder(const RelativeLocalizationOptions& options, const Footprint& footprint) : options_(options) {
  view_.side.footprint = footprint;
}

bool OwnRecorder::add(const Pose2& T_odom_base, const ObstacleScan& scan) {
  if (!view_.side.motion.empty()) {
    const TimedPose& last = view_.side.motion.latest();
    if (scan.stamp <= last.stamp) return false;
    view_.travel += (T_odom_base.position() - last.pose.position()).norm();
  }
  const Eigen::Vector2d origin = T_odom_base * scan.origin;
  SightRecord record;
  record.stamp = scan.stamp;
  record.T_odom_scan = {origin.x(), origin.y(), T_odom_base.yaw};
  record.scan = polarScanOf(scan, true);
  record.has_scan = true;
  for (const Blob& blob : scan.blobs) record.blobs.push_back({blob.position - scan.origin, blob.chord});
  const auto nearer = [](const SightedBlob& a, const SightedBlob& b) {
    return a.position.squaredNorm() < b.position.squaredNorm();
  };
  std::stable_sort(record.blobs.begin(), record.blobs.end(), nearer);
  record.blobs.resize(std::min(record.blobs.size(), static_cast<std::size_t>(options_.max_blobs)));
  newest_ = {next_id_, scan.stamp, record.T_odom_scan, polarScanOf(scan, false)};
  if (isKeyframeDue(record.T_odom_scan)) {
    keyframes_.push_back(newest_);
    if (keyframes_.size() > static_cast<std::size_t>(options_.own_keyframes)) keyframes_.pop_front();
    ++next_id_;
  }
  view_.side.motion.add({scan.stamp, T_odom_base, 0.0, 0.0, false});
  view_.side.add(std::move(record), static_cast<std::size_t>(options_.max_sights));
  is_stale_ = true;
  return true;
}

bool OwnRecorder::isKeyframeDue(const Pose2& T_odom_scan) const {
  if (keyframes_.empty()) return true;
  const Pose2& last = keyframes_.back().T_odom_scan;
  return (T_odom_scan.position() - last.position()).norm() >= options_.keyframe_distance ||
         std::abs(angleBetween(last.yaw, T_odom_scan.yaw)) >= options_.keyframe_angle;
}

void OwnRecorder::refresh() {
  if (!is_stale_) return;
  std::vector<PlacedScan> scans(keyframes_.begin(), keyframes_.end());
  if (scans.back().stamp != newest_.stamp) scans.push_back(newest_);
  view_.surfaces.set(std::move(scans));
  is_stale_ = false;
}

void OwnRecorder::forgetBefore(double stamp) {
  view_.side.forgetBefore(stamp);
  view_.side.motion.forgetBefore(stamp);
}

std::vector<Keyframe> OwnRecorder::keyframes(std::size_t count) const {
  std::vector<Keyframe> result;
  for (auto it = keyframes_.rbegin(); it != keyframes_.rend() && result.size() < count; ++it) {
    result.push_back({it->id, it->stamp, it->T_odom_scan, encodeScan(it->scan)});
  }
  return result;
}

std::vector<SightReport> OwnRecorder::reports(double since, std::size_t count) const {
  std::vector<const SightRecord*> seen;
  for (const SightRecord& sight : view_.side.sights) {
    if (sight.stamp > since && !sight.blobs.empty()) seen.push_back(&sight);
  }
  std::vector<SightReport> result;
  const std::size_t chosen = std::min(count, seen.size());
  for (std::size_t i = chosen; i-- > 0;) {
    // Most of them new, which finds a peer soon; the last one old: of little that is heard each piece is to say much.
    const double share = chosen == 1 ? 0.0 : static_cast<double>(i) / static_cast<double>(chosen - 1);
    const auto before = static_cast<std::size_t>(std::lround(share * share * static_cast<double>(seen.size() - 1)));
    const std::size_t place = seen.size() - 1 - std::max(before, i);
    const SightRecord& sight = *seen[place];
    const auto told = std::min(sight.blobs.size(), static_cast<std::size_t>(options_.max_told_blobs));
    result.push_back({sight.stamp, sight.T_odom_scan, {sight.blobs.begin(), sight.blobs.begin() + static_cast<long>(told)}});
  }
  return result;
}

}  // namespace parley

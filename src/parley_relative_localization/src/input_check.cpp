// SPDX-License-Identifier: BSD-3-Clause
#include "input_check.h"

#include <algorithm>
#include <cmath>

#include "parley_relative_localization/scan_descriptor.h"

namespace parley {
namespace {

constexpr double kFarthest = 1e5;         // [m] from an odom origin
constexpr double kLongestRange = 100.0;   // [m]
constexpr double kFastest = 50.0;         // [m/s] [rad/s]
constexpr double kLargest = 10.0;         // [m] side of a robot
constexpr std::size_t kMostBlobs = 256;   // [-]
constexpr std::size_t kMostBins = 20000;  // [-]
constexpr std::size_t kLongestName = 64;  // [-]

bool isWithin(double value, double limit) { return std::isfinite(value) && std::abs(value) <= limit; }

}  // namespace

bool isPlausible(const Pose2& pose) {
  return pose.isFinite() && isWithin(pose.x, kFarthest) && isWithin(pose.y, kFarthest) && isWithin(pose.yaw, 1e3);
}

bool isPlausible(const Footprint& footprint) {
  return isWithin(footprint.length, kLargest) && isWithin(footprint.width, kLargest) && footprint.length > 0.01 &&
         footprint.width > 0.01;
}

bool isPlausible(const ObstacleScan& scan) {
  const auto is_blob = [](const Blob& blob) {
    return isWithin(blob.position.x(), kFarthest) && isWithin(blob.position.y(), kFarthest) &&
           isWithin(blob.chord, kLongestRange);
  };
  return std::isfinite(scan.stamp) && isWithin(scan.range_max, kLongestRange) && scan.range_max > 0.0 &&
         isWithin(scan.origin.x(), kLargest) && isWithin(scan.origin.y(), kLargest) && scan.binCount() > 0 &&
         scan.binCount() <= kMostBins && std::all_of(scan.blobs.begin(), scan.blobs.end(), is_blob);
}

bool isPlausible(const MotionReport& motion) {
  return std::isfinite(motion.stamp) && isPlausible(motion.T_odom_base) && isWithin(motion.twist.speed, kFastest) &&
         isWithin(motion.twist.turn_rate, kFastest) && isPlausible(motion.footprint) && isWithin(motion.travel, 1e7) &&
         motion.travel >= 0.0;
}

bool isPlausible(const SightReport& report) {
  const auto is_blob = [](const SightedBlob& blob) {
    return isWithin(blob.position.x(), kLongestRange) && isWithin(blob.position.y(), kLongestRange) &&
           isWithin(blob.chord, kLargest);
  };
  return std::isfinite(report.stamp) && isPlausible(report.T_odom_scan) && report.blobs.size() <= kMostBlobs &&
         std::all_of(report.blobs.begin(), report.blobs.end(), is_blob);
}

bool isPlausible(const Keyframe& keyframe) {
  return std::isfinite(keyframe.stamp) && isPlausible(keyframe.T_odom_scan) && keyframe.descriptor.size() <= kMaxDescriptorBytes;
}

bool isPlausible(const RelativeEdge& edge) {
  const auto is_name = [](const std::string& name) { return !name.empty() && name.size() <= kLongestName; };
  return is_name(edge.from) && is_name(edge.to) && edge.from != edge.to && std::isfinite(edge.stamp) &&
         isPlausible(edge.T_odom_from) && isPlausible(edge.T_odom_to) && isWithin(edge.travel_from, 1e7) &&
         isWithin(edge.travel_to, 1e7) && edge.travel_from >= 0.0 && edge.travel_to >= 0.0 && isPlausible(edge.T_from_to.pose) &&
         isCovariance(edge.T_from_to.covariance);
}

}  // namespace parley

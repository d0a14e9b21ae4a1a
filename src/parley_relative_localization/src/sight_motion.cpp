// SPDX-License-Identifier: BSD-3-Clause
#include "sight_motion.h"

#include <cmath>

namespace parley {
namespace {

constexpr double kSameInstant = 0.12;  // [s] over which the twist tells the way

}  // namespace

void SightMotion::add(const MotionReport& report, MeetingSide& side) {
  newest_ = report;
  side.motion.add({report.stamp, report.T_odom_base, report.twist.speed, report.twist.turn_rate, true});
  read(side);
}

void SightMotion::read(MeetingSide& side) {
  if (side.motion.empty()) return;
  for (const SightRecord& sight : side.sights) {
    const double gap = sight.stamp - newest_.stamp;
    if (std::abs(gap) > kSameInstant) continue;
    const Pose2 T_odom_base = integrateTwist(newest_.T_odom_base, newest_.twist.speed, newest_.twist.turn_rate, gap);
    const Eigen::Vector2d p = T_odom_base.inverse() * sight.T_odom_scan.position();
    if (p.norm() < side.footprint.circumscribedRadius()) lidar_base_ = p;
  }
  if (!lidar_base_) return;
  for (const SightRecord& sight : side.sights) {
    const Eigen::Vector2d p = sight.T_odom_scan * -*lidar_base_;
    side.motion.add({sight.stamp, {p.x(), p.y(), sight.T_odom_scan.yaw}, 0.0, 0.0, false});
  }
}

}  // namespace parley

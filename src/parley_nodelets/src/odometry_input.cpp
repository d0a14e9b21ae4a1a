// SPDX-License-Identifier: BSD-3-Clause
#include "parley_nodelets/odometry_input.h"

#include "parley_nodelets/sensor_conversions.h"

namespace parley {
namespace {

constexpr double kTimeReset = 1.0;  // [s] going back by more means that time started again
constexpr int kQueue = 100;         // every reading counts: the lidar stage interpolates between them

}  // namespace

OdometryInput::OdometryInput(ros::NodeHandle& nh, const NodeConfig& config)
    : frames_(config.frames),
      buffer_(2.0, 2000, config.wiring.jump_distance, config.wiring.jump_angle),
      subscriber_(nh.subscribe("local_odom", kQueue, &OdometryInput::onOdometry, this, ros::TransportHints().tcpNoDelay())) {}

OdometrySnapshot OdometryInput::read() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return {buffer_, counters_};
}

void OdometryInput::clear() {
  const std::lock_guard<std::mutex> lock(mutex_);
  buffer_.clear();
}

void OdometryInput::onOdometry(const nav_msgs::OdometryConstPtr& message) {
  const std::optional<Odometry> reading = fromMessage(*message);
  const std::lock_guard<std::mutex> lock(mutex_);
  ++counters_.received;
  if (message->header.frame_id != frames_.local || message->child_frame_id != frames_.base) {
    ++counters_.wrong_frame;
    return;
  }
  if (!reading) {
    ++counters_.malformed;
    return;
  }
  switch (buffer_.add(*reading)) {
    case OdometryVerdict::kAccepted:
      break;
    case OdometryVerdict::kNotFinite:
      ++counters_.malformed;
      break;
    case OdometryVerdict::kOutOfOrder:
      ++counters_.out_of_order;
      break;
    case OdometryVerdict::kTimeWentBack:
      ++counters_.time_resets;
      break;
    case OdometryVerdict::kJumped:
      ++counters_.jumps;
      break;
  }
}

bool Continuity::broken(double now, const OdometryCounters& counters) {
  const bool back = now < last_now_ - kTimeReset;
  const int breaks = counters.jumps + counters.time_resets;
  const bool changed = back || breaks != breaks_;
  last_now_ = now;
  breaks_ = breaks;
  if (changed) broken_at_ = now;
  return changed;
}

bool Continuity::isCurrent(double stamp) const { return stamp >= broken_at_ && stamp <= last_now_ + kTimeReset; }

}  // namespace parley

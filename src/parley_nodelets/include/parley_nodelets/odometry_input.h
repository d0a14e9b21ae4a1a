// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/Odometry.h>
#include <ros/node_handle.h>
#include <ros/subscriber.h>

#include <mutex>

#include "parley_geometry/odometry_buffer.h"
#include "parley_nodelets/node_config.h"

namespace parley {

/// What of the odometry was thrown away, since the start.
struct OdometryCounters {
  int received = 0;      // [-]
  int wrong_frame = 0;   // [-] frame_id or child_frame_id is not what the node was told
  int malformed = 0;     // [-] not finite, or no rotation
  int out_of_order = 0;  // [-]
  int jumps = 0;         // [-]
  int time_resets = 0;   // [-]
};

/// Odometry at one moment, safe to use in the worker.
struct OdometrySnapshot {
  OdometryBuffer buffer;
  OdometryCounters counters;
};

/// The last seconds of the topic `local_odom`, filled by its callback and read by the worker.
class OdometryInput {
 public:
  OdometryInput(ros::NodeHandle& nh, const NodeConfig& config);

  OdometrySnapshot read() const;
  /// Forgets all readings, as when time starts again.
  void clear();
  const ros::Subscriber& subscriber() const { return subscriber_; }

 private:
  void onOdometry(const nav_msgs::OdometryConstPtr& message);

  Frames frames_;
  mutable std::mutex mutex_;
  OdometryBuffer buffer_;
  OdometryCounters counters_;
  ros::Subscriber subscriber_;
};

/// Notices that what a stage has gathered no longer belongs to the present: time went back or odometry jumped.
class Continuity {
 public:
  /// True once for each break. `now`: the node's time [s].
  bool broken(double now, const OdometryCounters& counters);

  /// Whether data of this time [s] was made after the last break, and not in a time that has been left.
  bool isCurrent(double stamp) const;

 private:
  double last_now_ = -1e9;   // [s]
  double broken_at_ = -1e9;  // [s]
  int breaks_ = 0;
};

}  // namespace parley

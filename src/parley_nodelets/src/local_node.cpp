// SPDX-License-Identifier: BSD-3-Clause
#include "parley_nodelets/local_node.h"

#include "parley_nodelets/report.h"
#include "parley_nodelets/sensor_conversions.h"

namespace parley {
namespace {

constexpr int kQueue = 100;  // every reading counts

/// The stage has none of its own.
struct NoOptions {
  template <class Visitor>
  void visit(Visitor&) {}
};

}  // namespace

LocalNode::LocalNode(ros::NodeHandle nh, const ros::NodeHandle& pnh, const std::string& name)
    : config_(loadStageConfig<NoOptions>(pnh).node),
      worker_(name, [] {}),
      diagnostics_(nh, pnh, name),
      inputs_(nh, name),
      odometry_({config_.wiring.correction_distance, config_.wiring.correction_angle, config_.wiring.jump_distance,
                 config_.wiring.jump_angle},
                config_.limits),
      publisher_(nh.advertise<nav_msgs::Odometry>("local_odom", kQueue)) {
  if (config_.frames.local != config_.frames.odom) place();
  const auto take = [this](const nav_msgs::OdometryConstPtr& m) { worker_.post([this, m] { process(*m); }); };
  subscriber_ = nh.subscribe<nav_msgs::Odometry>("odom", kQueue, take, nullptr, ros::TransportHints().tcpNoDelay());
  inputs_.expect<nav_msgs::Odometry>(subscriber_);
  diagnostics_.setHardwareID(config_.frames.base);
  diagnostics_.add("stage", [this](Report& status) { report(status); });
  worker_.every(nh, 1.0, [this] { diagnostics_.update(); });
  worker_.start();
}

LocalNode::~LocalNode() { worker_.stop(); }

void LocalNode::process(const nav_msgs::Odometry& message) {
  ++received_;
  if (message.header.frame_id != config_.frames.odom || message.child_frame_id != config_.frames.base) {
    ++wrong_frame_;
    return;
  }
  const std::optional<Odometry> reading = fromMessage(message);
  if (!reading) {
    ++malformed_;
    return;
  }
  const bool has_frame = config_.frames.local != config_.frames.odom;
  const Odometry local = has_frame ? odometry_.add(*reading) : *reading;
  if (has_frame) place();
  publisher_.publish(boost::make_shared<nav_msgs::Odometry>(toMessage(local, config_.frames.local, config_.frames.base)));
}

/// Tells where the local frame lies, whenever that has changed.
void LocalNode::place() {
  const Pose2& T_odom_local = odometry_.odomFromLocal();
  if (placed_ && placed_->position() == T_odom_local.position() && placed_->yaw == T_odom_local.yaw) return;
  placed_ = T_odom_local;
  geometry_msgs::TransformStamped transform;
  transform.header.frame_id = config_.frames.odom;
  transform.header.stamp = ros::Time::now();
  transform.child_frame_id = config_.frames.local;
  transform.transform.translation.x = T_odom_local.x;
  transform.transform.translation.y = T_odom_local.y;
  transform.transform.rotation = toQuaternion(T_odom_local.yaw);
  transforms_.sendTransform(transform);
}

void LocalNode::report(Report& report) const {
  report.summary(Report::OK, "");
  if (received_ == 0) report.mergeSummary(Report::WARN, "no odometry");
  if (wrong_frame_ > 0) {
    report.mergeSummaryf(Report::WARN, "odometry is not from %s to %s", config_.frames.odom.c_str(), config_.frames.base.c_str());
  }
  report.add("odometry received", received_);
  report.add("odometry in other frames", wrong_frame_);
  report.add("odometry malformed", malformed_);
  report.add("corrections", odometry_.corrections());
  report.add("exceptions", worker_.errors());
}

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#include "parley_nodelets/lidar_node.h"

#include <parley_msgs/ObstacleScan.h>
#include <parley_msgs/TrackedObjects.h>

#include "parley_nodelets/report.h"
#include "parley_nodelets/sensor_conversions.h"
#include "parley_nodelets/stage_conversions.h"
#include "parley_nodelets/team_conversions.h"

namespace parley {
namespace {

constexpr double kOldBody = 0.5;  // [s] a teammate has gone elsewhere by then

}  // namespace

LidarNode::LidarNode(ros::NodeHandle nh, const ros::NodeHandle& pnh, const std::string& name)
    : config_(loadStageConfig<LidarOptions>(pnh)),
      worker_(name, [] {}),
      diagnostics_(nh, pnh, name),
      inputs_(nh, name),
      stage_(std::make_unique<LidarStage>(config_.stage, config_.node.footprint, config_.node.mount)),
      obstacles_(nh.advertise<parley_msgs::ObstacleScan>("obstacles", 1)),
      tracks_(nh.advertise<parley_msgs::TrackedObjects>("tracks", 1)),
      odometry_(nh, config_.node) {
  const auto wake = [this] { worker_.post([this] { process(); }); };
  scan_subscriber_ = nh.subscribe<sensor_msgs::LaserScan>("scan", 1, [this, wake](const sensor_msgs::LaserScanConstPtr& m) {
    scan_.put(m);
    wake();
  });
  cloud_subscriber_ =
      nh.subscribe<sensor_msgs::PointCloud2>("points", 1, [this, wake](const sensor_msgs::PointCloud2ConstPtr& m) {
        cloud_.put(m);
        wake();
      });
  teammates_subscriber_ = nh.subscribe<parley_msgs::Teammates>(
      "teammates", 1, [this](const parley_msgs::TeammatesConstPtr& m) { teammates_.put(m); });
  inputs_.expect<nav_msgs::Odometry>(odometry_.subscriber());
  inputs_.expectEither<sensor_msgs::LaserScan, sensor_msgs::PointCloud2>(scan_subscriber_, cloud_subscriber_);
  diagnostics_.setHardwareID(config_.node.frames.base);
  diagnostics_.add("stage", [this](Report& status) { report(status); });
  worker_.every(nh, 1.0, [this] { diagnostics_.update(); });
  worker_.start();
}

LidarNode::~LidarNode() { worker_.stop(); }

void LidarNode::process() {
  const OdometrySnapshot odometry = odometry_.read();
  const double now = ros::Time::now().toSec();
  if (continuity_.broken(now, odometry.counters)) stage_->reset();
  const std::vector<KnownTeammate> teammates = bodies(now);
  if (const auto message = scan_.take()) publish(stage_->process(fromMessage(*message), odometry.buffer, teammates));
  if (const auto message = cloud_.take()) {
    if (const std::optional<LidarCloud> cloud = fromMessage(*message)) {
      publish(stage_->process(*cloud, odometry.buffer, teammates));
    } else {
      ++malformed_;
      last_status_ = {LidarCode::kMalformed, "the cloud has no x, y, z, or is shorter than it says"};
    }
  }
}

/// Teammates whose returns are to be kept off the map; none where the last message is old.
std::vector<KnownTeammate> LidarNode::bodies(double now) {
  if (const auto message = teammates_.take(); message && message->header.frame_id == config_.node.frames.local) {
    bodies_ = fromMessage(*message).value_or(std::vector<KnownTeammate>{});
    bodies_stamp_ = message->header.stamp.toSec();
  }
  const bool current = continuity_.isCurrent(bodies_stamp_) && now - bodies_stamp_ < kOldBody;
  return current ? bodies_ : std::vector<KnownTeammate>{};
}

void LidarNode::publish(const LidarResult& result) {
  last_status_ = result.status;
  if (!result.status.is(LidarCode::kOk)) {
    ++rejected_;
    return;
  }
  ++accepted_;
  last_stamp_ = result.scan.stamp;
  const Frames& frames = config_.node.frames;
  tracks_.publish(boost::make_shared<parley_msgs::TrackedObjects>(toMessage(result.tracks, last_stamp_, frames.local)));
  obstacles_.publish(boost::make_shared<parley_msgs::ObstacleScan>(toMessage(result.scan, frames.base)));
}

void LidarNode::report(Report& report) const {
  constexpr double kOld = 1.0;  // [s]
  const double now = ros::Time::now().toSec();
  report.summary(Report::OK, "");
  if (!last_status_.is(LidarCode::kOk)) report.mergeSummary(Report::WARN, last_status_.text);
  if (now - last_stamp_ > kOld) report.mergeSummary(Report::ERROR, "no usable scan for more than 1 s");
  report.add("scans accepted", accepted_);
  report.add("scans rejected", rejected_);
  report.add("clouds malformed", malformed_);
  report.add("exceptions", worker_.errors());
  reportOdometry(report, odometry_.read(), config_.node.frames, now);
}

}  // namespace parley

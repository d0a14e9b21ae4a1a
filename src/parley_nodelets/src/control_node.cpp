// SPDX-License-Identifier: BSD-3-Clause
#include "parley_nodelets/control_node.h"

#include <geometry_msgs/Twist.h>
#include <parley_msgs/RobotState.h>

#include "parley_nodelets/motion_conversions.h"
#include "parley_nodelets/report.h"
#include "parley_nodelets/stage_conversions.h"

namespace parley {

ControlNode::ControlNode(ros::NodeHandle nh, const ros::NodeHandle& pnh, const std::string& name)
    : config_(loadStageConfig<ControlOptions>(pnh)),
      worker_(name, [this] { publishTwist({}); }),
      diagnostics_(nh, pnh, name),
      inputs_(nh, name),
      controller_(std::make_unique<Controller>(config_.stage, config_.node.footprint, config_.node.limits)),
      twist_(nh.advertise<geometry_msgs::Twist>("cmd_vel", 1)),
      state_(nh.advertise<parley_msgs::RobotState>("robot_state", 1)),
      odometry_(nh, config_.node) {
  trajectory_subscriber_ = nh.subscribe<parley_msgs::Trajectory>(
      "trajectory", 1, [this](const parley_msgs::TrajectoryConstPtr& m) { new_trajectory_.put(m); });
  goal_subscriber_ = nh.subscribe<parley_msgs::Goal>("goal", 1, [this](const parley_msgs::GoalConstPtr& m) { new_goal_.put(m); });
  obstacles_subscriber_ = nh.subscribe<parley_msgs::ObstacleScan>(
      "obstacles", 1, [this](const parley_msgs::ObstacleScanConstPtr& m) { new_scan_.put(m); });
  inputs_.expect<nav_msgs::Odometry>(odometry_.subscriber());
  inputs_.expect<parley_msgs::Trajectory>(trajectory_subscriber_);
  inputs_.expect<parley_msgs::Goal>(goal_subscriber_);
  inputs_.expect<parley_msgs::ObstacleScan>(obstacles_subscriber_);
  diagnostics_.setHardwareID(config_.node.frames.base);
  diagnostics_.add("stage", [this](Report& status) { report(status); });
  worker_.every(nh, config_.stage.period, [this] { step(); });
  worker_.every(nh, 1.0, [this] { diagnostics_.update(); });
  worker_.start();
}

ControlNode::~ControlNode() {
  worker_.stop();
  publishTwist({});
}

void ControlNode::step() {
  const double now = ros::Time::now().toSec();
  const OdometrySnapshot odometry = odometry_.read();
  if (continuity_.broken(now, odometry.counters)) {
    plan_.clear();
    controller_->reset();
    scan_.reset();
  }
  takeInputs(odometry.buffer);
  plan_.advance(now);
  last_result_ = control(now, odometry.buffer);
  publishTwist(last_result_.twist);
  const double stamp = odometry.buffer.empty() ? now : odometry.buffer.latest().stamp;
  state_.publish(boost::make_shared<parley_msgs::RobotState>(toMessage(last_result_, stamp, config_.node.frames.base)));
}

void ControlNode::takeInputs(const OdometryBuffer& odometry) {
  if (const auto message = new_goal_.take()) has_goal_ = message->active;
  if (const auto message = new_trajectory_.take()) {
    const std::optional<TimedPlan> plan = fromMessage(*message);
    if (plan && message->header.frame_id == config_.node.frames.local && continuity_.isCurrent(plan->made_at)) {
      plan_.offer(plan->result, plan->made_at, plan->start_time);
    } else {
      ++rejected_;
    }
  }
  if (const auto message = new_scan_.take()) {
    std::optional<ObstacleScan> scan = fromMessage(*message);
    const std::optional<Odometry> at_scan = scan ? odometry.at(scan->stamp) : std::nullopt;
    if (at_scan && message->header.frame_id == config_.node.frames.base && continuity_.isCurrent(scan->stamp)) {
      scan_ = std::move(scan);
      T_odom_scan_ = at_scan->pose;
    } else {
      ++rejected_;
    }
  }
}

ControlResult ControlNode::control(double now, const OdometryBuffer& odometry) {
  ControlRequest request;
  request.now = now;
  request.odometry = odometry.empty() ? nullptr : &odometry.latest();
  request.trajectory = &plan_.trajectory();
  request.trajectory_stamp = plan_.stamp();
  request.scan = scan_ ? &*scan_ : nullptr;
  request.T_odom_scan = T_odom_scan_;
  request.intent = has_goal_ ? plan_.state() : DriveState::kStopped;
  request.intent_reason = has_goal_ ? plan_.reason() : "no goal";
  return controller_->step(request);
}

void ControlNode::publishTwist(const Twist2& twist) {
  auto message = boost::make_shared<geometry_msgs::Twist>();
  message->linear.x = twist.speed;
  message->angular.z = twist.turn_rate;
  twist_.publish(message);
}

void ControlNode::report(Report& report) const {
  report.summary(last_result_.emergency ? Report::WARN : Report::OK, toString(last_result_.state));
  if (!last_result_.reason.empty()) report.mergeSummary(Report::OK, last_result_.reason);
  const bool blind = last_result_.state == DriveState::kNoLidar || last_result_.state == DriveState::kNoOdometry;
  if (blind) report.mergeSummary(Report::ERROR, "standing for want of a sensor");
  report.add("speed", last_result_.twist.speed);
  report.add("turn rate", last_result_.twist.turn_rate);
  report.add("trajectories committed", plan_.count());
  report.add("messages rejected", rejected_);
  report.add("exceptions", worker_.errors());
  reportOdometry(report, odometry_.read(), config_.node.frames, ros::Time::now().toSec());
}

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#include "parley_nodelets/goal_input.h"

#include <actionlib/server/simple_action_server.h>
#include <geometry_msgs/PoseStamped.h>
#include <move_base_msgs/MoveBaseAction.h>
#include <tf2_ros/transform_listener.h>

#include <atomic>
#include <mutex>

#include "parley_nodelets/sensor_conversions.h"

namespace parley {
namespace {

using ActionServer = actionlib::SimpleActionServer<move_base_msgs::MoveBaseAction>;

constexpr double kMoved = 0.005;      // [m] less is not worth another route
constexpr double kLongestWait = 5.0;  // [s] for the local frame's place, before a goal is given up

struct Brought {
  std::optional<Eigen::Vector2d> place;
  std::string problem;
};

Brought refusedBecause(const std::string& problem) { return {std::nullopt, problem}; }

}  // namespace

struct GoalInput::Parts {
  Parts(const ros::NodeHandle& nh, const Frames& names) : frames(names), listener(buffer), action(nh, "move_base", false) {}

  Brought brought(const Eigen::Vector2d& p, const std::string& from, const std::string& to) const;
  Brought toOdom(const geometry_msgs::PoseStamped& pose) const;
  /// The goal in the local frame; a problem as long as nobody has told where that is.
  Brought local() const { return brought(*goal_odom, frames.odom, frames.local); }
  bool waits(double now);
  void onTopic(const geometry_msgs::PoseStamped& pose);
  void onAction();
  void onPreempt();
  void order(const std::optional<Eigen::Vector2d>& goal);

  Frames frames;
  tf2_ros::Buffer buffer;
  tf2_ros::TransformListener listener;
  std::mutex mutex;
  std::optional<Eigen::Vector2d> goal_odom;              // [m] nothing: stand
  bool is_new = false;                                   // not taken yet
  std::optional<double> waits_since;                     // [s] for the local frame's place
  Eigen::Vector2d told_local = Eigen::Vector2d::Zero();  // [m] the goal as it was taken
  std::atomic<int> refused{0};
  ActionServer action;
  ros::Subscriber topic;
};

/// The newest transform counts: a goal is where people see it now, whatever the stamp that their tool has given it.
Brought GoalInput::Parts::brought(const Eigen::Vector2d& p, const std::string& from, const std::string& to) const {
  if (from == to) return {p, ""};
  try {
    const geometry_msgs::TransformStamped t = buffer.lookupTransform(to, from, ros::Time(0));
    const std::optional<Attitude> attitude = attitudeOf(t.transform.rotation);
    if (!attitude) return refusedBecause("the transform from " + from + " to " + to + " has no rotation");
    const Pose2 T_to_from{t.transform.translation.x, t.transform.translation.y, attitude->yaw};
    return {T_to_from * p, ""};
  } catch (const tf2::TransformException& error) {
    return refusedBecause("no transform from '" + from + "' to " + to + ": " + error.what());
  }
}

Brought GoalInput::Parts::toOdom(const geometry_msgs::PoseStamped& pose) const {
  const Eigen::Vector2d p(pose.pose.position.x, pose.pose.position.y);
  if (!p.allFinite()) return refusedBecause("the goal is not finite");
  return brought(p, pose.header.frame_id, frames.odom);
}

void GoalInput::Parts::order(const std::optional<Eigen::Vector2d>& goal) {
  const std::lock_guard<std::mutex> lock(mutex);
  goal_odom = goal;
  is_new = true;
  waits_since.reset();
}

/// Whether a goal that the local frame does not have yet is still waited for: no longer than `kLongestWait`.
bool GoalInput::Parts::waits(double now) {
  if (!waits_since || now < *waits_since) waits_since = now;
  return now - *waits_since <= kLongestWait;
}

void GoalInput::Parts::onTopic(const geometry_msgs::PoseStamped& pose) {
  const Brought goal = toOdom(pose);
  if (!goal.place) {
    ++refused;
    ROS_ERROR_STREAM("goal refused: " << goal.problem);
    return;
  }
  if (action.isActive()) action.setPreempted({}, "a goal came on move_base_simple/goal");
  order(goal.place);
}

void GoalInput::Parts::onAction() {
  const auto accepted = action.acceptNewGoal();
  const Brought goal = toOdom(accepted->target_pose);
  if (!goal.place) {
    ++refused;
    action.setAborted({}, "goal refused: " + goal.problem);
  }
  order(goal.place);
}

void GoalInput::Parts::onPreempt() {
  const bool replaced = action.isNewGoalAvailable();
  action.setPreempted({}, replaced ? "another goal came" : "cancelled");
  if (!replaced) order(std::nullopt);
}

GoalInput::GoalInput(const ros::NodeHandle& nh, const Frames& frames) : parts_(std::make_unique<Parts>(nh, frames)) {
  Parts* parts = parts_.get();
  parts->action.registerGoalCallback([parts] { parts->onAction(); });
  parts->action.registerPreemptCallback([parts] { parts->onPreempt(); });
  ros::NodeHandle handle(nh);
  parts->topic = handle.subscribe<geometry_msgs::PoseStamped>(
      "move_base_simple/goal", 1, [parts](const geometry_msgs::PoseStampedConstPtr& pose) { parts->onTopic(*pose); });
  parts->action.start();
}

GoalInput::~GoalInput() = default;

std::optional<GoalOrder> GoalInput::take(double now) {
  Parts& p = *parts_;
  std::unique_lock<std::mutex> lock(p.mutex);
  if (!p.is_new) return std::nullopt;
  const Brought local = p.goal_odom ? p.local() : Brought();
  if (!local.problem.empty() && p.waits(now)) {
    ROS_WARN_STREAM_THROTTLE(5.0, "the goal waits: " << local.problem);
    return std::nullopt;
  }
  p.is_new = false;
  if (local.place) p.told_local = *local.place;
  if (!local.problem.empty()) {
    p.goal_odom.reset();
    ++p.refused;
    lock.unlock();  // the action has a lock of its own
    ROS_ERROR_STREAM("goal refused: " << local.problem);
    abort("goal refused: " + local.problem);
  }
  return GoalOrder{local.place};
}

std::optional<Eigen::Vector2d> GoalInput::moved() {
  Parts& p = *parts_;
  const std::lock_guard<std::mutex> lock(p.mutex);
  if (!p.goal_odom || p.is_new) return std::nullopt;
  std::optional<Eigen::Vector2d> place = p.local().place;
  if (!place || (*place - p.told_local).norm() < kMoved) return std::nullopt;
  p.told_local = *place;
  return place;
}

bool GoalInput::actionRuns() const { return parts_->action.isActive(); }

void GoalInput::feedback(const Pose2& T_local_base, double stamp) {
  move_base_msgs::MoveBaseFeedback feedback;
  feedback.base_position.header.stamp = toRosTime(stamp);
  feedback.base_position.header.frame_id = parts_->frames.local;
  feedback.base_position.pose = toPose(T_local_base);
  parts_->action.publishFeedback(feedback);
}

void GoalInput::succeed(const std::string& text) {
  if (parts_->action.isActive()) parts_->action.setSucceeded({}, text);
}

void GoalInput::abort(const std::string& text) {
  if (parts_->action.isActive()) parts_->action.setAborted({}, text);
}

int GoalInput::refused() const { return parts_->refused; }

}  // namespace parley

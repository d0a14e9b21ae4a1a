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

struct Brought {
  std::optional<Eigen::Vector2d> goal_odom;
  std::string problem;
};

Brought refusedBecause(const std::string& problem) { return {std::nullopt, problem}; }

}  // namespace

struct GoalInput::Parts {
  Parts(const ros::NodeHandle& nh, const std::string& odom)
      : odom_frame(odom), listener(buffer), action(nh, "move_base", false) {}

  Brought toOdom(const geometry_msgs::PoseStamped& pose) const;
  void onTopic(const geometry_msgs::PoseStamped& pose);
  void onAction();
  void onPreempt();
  void order(const std::optional<Eigen::Vector2d>& goal_odom);

  std::string odom_frame;
  tf2_ros::Buffer buffer;
  tf2_ros::TransformListener listener;
  std::mutex mutex;
  std::optional<GoalOrder> newest;
  std::atomic<int> refused{0};
  ActionServer action;
  ros::Subscriber topic;
};

/// The newest transform counts: a goal is where people see it now, whatever the stamp that their tool has given it.
Brought GoalInput::Parts::toOdom(const geometry_msgs::PoseStamped& pose) const {
  const Eigen::Vector2d p(pose.pose.position.x, pose.pose.position.y);
  const std::string& frame = pose.header.frame_id;
  if (!p.allFinite()) return refusedBecause("the goal is not finite");
  if (frame == odom_frame) return {p, ""};
  try {
    const geometry_msgs::TransformStamped t = buffer.lookupTransform(odom_frame, frame, ros::Time(0));
    const std::optional<Attitude> attitude = attitudeOf(t.transform.rotation);
    if (!attitude) return refusedBecause("the transform from " + frame + " to " + odom_frame + " has no rotation");
    const Pose2 T_odom_frame{t.transform.translation.x, t.transform.translation.y, attitude->yaw};
    return {T_odom_frame * p, ""};
  } catch (const tf2::TransformException& error) {
    return refusedBecause("no transform from '" + frame + "' to " + odom_frame + ": " + error.what());
  }
}

void GoalInput::Parts::order(const std::optional<Eigen::Vector2d>& goal_odom) {
  const std::lock_guard<std::mutex> lock(mutex);
  newest = GoalOrder{goal_odom};
}

void GoalInput::Parts::onTopic(const geometry_msgs::PoseStamped& pose) {
  const Brought brought = toOdom(pose);
  if (!brought.goal_odom) {
    ++refused;
    ROS_ERROR_STREAM("goal refused: " << brought.problem);
    return;
  }
  if (action.isActive()) action.setPreempted({}, "a goal came on move_base_simple/goal");
  order(brought.goal_odom);
}

void GoalInput::Parts::onAction() {
  const auto goal = action.acceptNewGoal();
  const Brought brought = toOdom(goal->target_pose);
  if (!brought.goal_odom) {
    ++refused;
    action.setAborted({}, "goal refused: " + brought.problem);
  }
  order(brought.goal_odom);
}

void GoalInput::Parts::onPreempt() {
  const bool replaced = action.isNewGoalAvailable();
  action.setPreempted({}, replaced ? "another goal came" : "cancelled");
  if (!replaced) order(std::nullopt);
}

GoalInput::GoalInput(const ros::NodeHandle& nh, const std::string& odom_frame) : parts_(std::make_unique<Parts>(nh, odom_frame)) {
  Parts* parts = parts_.get();
  parts->action.registerGoalCallback([parts] { parts->onAction(); });
  parts->action.registerPreemptCallback([parts] { parts->onPreempt(); });
  ros::NodeHandle handle(nh);
  parts->topic = handle.subscribe<geometry_msgs::PoseStamped>(
      "move_base_simple/goal", 1, [parts](const geometry_msgs::PoseStampedConstPtr& pose) { parts->onTopic(*pose); });
  parts->action.start();
}

GoalInput::~GoalInput() = default;

std::optional<GoalOrder> GoalInput::take() {
  const std::lock_guard<std::mutex> lock(parts_->mutex);
  return std::exchange(parts_->newest, std::nullopt);
}

bool GoalInput::actionRuns() const { return parts_->action.isActive(); }

void GoalInput::feedback(const Pose2& T_odom_base, double stamp) {
  move_base_msgs::MoveBaseFeedback feedback;
  feedback.base_position.header.stamp = toRosTime(stamp);
  feedback.base_position.header.frame_id = parts_->odom_frame;
  feedback.base_position.pose = toPose(T_odom_base);
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

// SPDX-License-Identifier: BSD-3-Clause
#include <actionlib/client/simple_action_client.h>
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/Twist.h>
#include <move_base_msgs/MoveBaseAction.h>
#include <parley_msgs/Goal.h>
#include <parley_msgs/PeerMotions.h>
#include <parley_msgs/RobotState.h>
#include <parley_msgs/Trajectory.h>

#include <tf2_ros/static_transform_broadcaster.h>

#include "node_fixture.h"
#include "parley_nodelets/control_node.h"
#include "parley_nodelets/lidar_node.h"
#include "parley_nodelets/planner_node.h"
#include "parley_nodelets/topology_node.h"

namespace parley {
namespace {

using test::Listener;
using test::refusal;
using ActionClient = actionlib::SimpleActionClient<move_base_msgs::MoveBaseAction>;

/// A robot that stands in the room whatever it is told.
class DrivingTest : public test::NodeFixture {
 protected:
  LidarNode lidar_{nh_, pnh("lidar"), "lidar"};
  TopologyNode topology_{nh_, pnh("topology"), "topology"};
  ros::Publisher goals_{nh_.advertise<geometry_msgs::PoseStamped>("move_base_simple/goal", 1, true)};
  Listener<parley_msgs::Goal> goal_{nh_, "goal"};
  Listener<parley_msgs::Trajectory> trajectory_{nh_, "trajectory"};
  Listener<geometry_msgs::Twist> twist_{nh_, "cmd_vel"};
  Listener<parley_msgs::RobotState> state_{nh_, "robot_state"};

  static geometry_msgs::PoseStamped pose(double x, double y, const std::string& frame) {
    geometry_msgs::PoseStamped message;
    message.header.frame_id = frame;
    message.pose.position.x = x;
    message.pose.position.y = y;
    message.pose.orientation.w = 1.0;
    return message;
  }

  /// Bob, who would go through where this robot stands, and before it; or through the wall, if he cannot be.
  parley_msgs::PeerMotions bob(double width) const {
    parley_msgs::PeerMotions message;
    message.header = headerOf(time_, "odom");
    message.id = 7;
    message.peers.resize(1);
    parley_msgs::PeerMotion& peer = message.peers[0];
    peer.id = peer.intent.holder = 9;
    peer.length = 0.8;
    peer.width = width;
    peer.heard = ros::Time(time_);
    peer.trajectory.resize(1);
    peer.trajectory[0].stamp = ros::Time(time_);
    peer.trajectory[0].x = 2.0;
    peer.trajectory[0].yaw = kPi;
    peer.intent.priority = 1.0;
    peer.intent.way.resize(2);
    peer.intent.way[0].x = 2.0;
    peer.intent.way[1].x = -3.0;
    return message;
  }

  bool hasVerdict(std::uint8_t verdict) const { return trajectory_.count() > 0 && trajectory_.last()->verdict == verdict; }
  bool drives() const { return twist_.count() > 0 && twist_.last()->linear.x > 0.05; }
};

TEST_F(DrivingTest, PlannerPlansToAGoal) {
  const PlannerNode node(nh_, pnh("planner"), "planner");
  goals_.publish(pose(3.0, 0.0, "odom"));
  ASSERT_TRUE(
      passUntil([this] { return trajectory_.count() > 0 && trajectory_.last()->verdict == parley_msgs::Trajectory::DRIVING; }));
  const auto plan = trajectory_.last();
  EXPECT_EQ(plan->verdict, parley_msgs::Trajectory::DRIVING) << plan->text;
  EXPECT_NEAR((plan->start - plan->header.stamp).toSec(), 0.05, 1e-6);
  EXPECT_EQ(plan->points.back().speed, 0.0) << "ends standing";
  ASSERT_GT(goal_.count(), 0);
  EXPECT_TRUE(goal_.last()->active);
  EXPECT_EQ(goal_.last()->position.x, 3.0);
}

TEST_F(DrivingTest, AGoalStaysWhereItIsInOdometrysFrame) {
  pnh("planner").setParam("frames/odom", "drifting");  // what the fixture's sensors are in is the local frame
  const PlannerNode node(nh_, pnh("planner"), "planner");
  tf2_ros::StaticTransformBroadcaster transforms;
  const auto place = [&](double x, double y, double yaw) {
    geometry_msgs::TransformStamped transform;
    transform.header = headerOf(time_, "drifting");
    transform.child_frame_id = "odom";
    transform.transform.translation.x = x;
    transform.transform.translation.y = y;
    transform.transform.rotation = toQuaternion(yaw);
    transforms.sendTransform(transform);
  };
  const auto goalIs = [this](double x, double y) {
    return goal_.count() > 0 && std::hypot(goal_.last()->position.x - x, goal_.last()->position.y - y) < 1e-6;
  };
  goals_.publish(pose(3.0, 1.0, "drifting"));
  passFor(0.5);
  EXPECT_EQ(goal_.count(), 0) << "held back until the local frame has a place";
  place(0.0, 0.0, 0.0);
  ASSERT_TRUE(passUntil([&] { return goalIs(3.0, 1.0); }));
  place(1.0, 0.0, 0.5 * kPi);
  EXPECT_TRUE(passUntil([&] { return goalIs(1.0, -2.0); }));
  EXPECT_EQ(goal_.last()->header.frame_id, "odom");
}

TEST_F(DrivingTest, AGoalThatTheLocalFrameNeverHasIsGivenUp) {
  pnh("planner").setParam("frames/odom", "drifting");
  const PlannerNode node(nh_, pnh("planner"), "planner");
  ActionClient client(nh_, "move_base", false);
  ASSERT_TRUE(passUntil([&client] { return client.isServerConnected(); }));
  move_base_msgs::MoveBaseGoal goal;
  goal.target_pose = pose(3.0, 1.0, "drifting");
  client.sendGoal(goal);
  passFor(2.0);
  EXPECT_FALSE(client.getState().isDone()) << client.getState().getText();
  ASSERT_TRUE(passUntil([&client] { return client.getState().isDone(); }));
  EXPECT_EQ(client.getState(), actionlib::SimpleClientGoalState::ABORTED);
  EXPECT_NE(client.getState().getText().find("drifting"), std::string::npos) << client.getState().getText();
}

TEST_F(DrivingTest, GoalsThatAreNowhereAreRefused) {
  const PlannerNode node(nh_, pnh("planner"), "planner");
  goals_.publish(pose(std::nan(""), 0.0, "odom"));
  passFor(0.5);
  goals_.publish(pose(1.0, 0.0, "the_moon"));
  passFor(0.5);
  EXPECT_EQ(goal_.count(), 0);
  EXPECT_EQ(trajectory_.count(), 0);
}

TEST_F(DrivingTest, ActionEndsAsItSays) {
  pnh("planner").setParam("goal/patience", 2.0);
  const PlannerNode node(nh_, pnh("planner"), "planner");
  ActionClient client(nh_, "move_base", false);
  ASSERT_TRUE(passUntil([&client] { return client.isServerConnected(); }));

  move_base_msgs::MoveBaseGoal goal;
  goal.target_pose = pose(0.1, 0.0, "odom");
  client.sendGoal(goal);
  ASSERT_TRUE(passUntil([&client] { return client.getState().isDone(); }));
  EXPECT_EQ(client.getState(), actionlib::SimpleClientGoalState::SUCCEEDED) << client.getState().getText();

  goal.target_pose = pose(30.0, 0.0, "odom");  // behind the walls of a closed room
  client.sendGoal(goal);
  ASSERT_TRUE(passUntil([&client] { return client.getState().isDone(); }));
  EXPECT_EQ(client.getState(), actionlib::SimpleClientGoalState::ABORTED);
  EXPECT_EQ(client.getState().getText().rfind("no_route", 0), 0U) << client.getState().getText();

  goal.target_pose = pose(1.0, 0.0, "the_moon");
  client.sendGoal(goal);
  ASSERT_TRUE(passUntil([&client] { return client.getState().isDone(); }));
  EXPECT_NE(client.getState().getText().find("the_moon"), std::string::npos) << client.getState().getText();

  goal.target_pose = pose(3.0, 0.0, "odom");
  client.sendGoal(goal);
  ASSERT_TRUE(passUntil([&] { return client.getState() == actionlib::SimpleClientGoalState::ACTIVE && goal_.last()->active; }));
  client.cancelGoal();
  ASSERT_TRUE(passUntil([&] { return client.getState().isDone() && !goal_.last()->active; }));
  EXPECT_EQ(client.getState(), actionlib::SimpleClientGoalState::PREEMPTED);

  client.sendGoal(goal);
  ASSERT_TRUE(passUntil([&] { return goal_.last()->active; }));
  goals_.publish(pose(2.0, 1.0, "odom"));
  ASSERT_TRUE(passUntil([&] { return client.getState().isDone() && goal_.last()->position.y == 1.0; }));
  EXPECT_EQ(client.getState(), actionlib::SimpleClientGoalState::PREEMPTED);
}

TEST_F(DrivingTest, PlannerMakesRoomForTeammatesAndSaysSo) {
  const PlannerNode node(nh_, pnh("planner"), "planner");
  ros::Publisher team = nh_.advertise<parley_msgs::PeerMotions>("peer_motions", 1);
  ActionClient client(nh_, "move_base", false);
  ASSERT_TRUE(passUntil([&client] { return client.isServerConnected(); }));
  move_base_msgs::MoveBaseGoal goal;
  goal.target_pose = pose(0.1, 0.0, "odom");
  client.sendGoal(goal);
  parley_msgs::PeerMotions alone;
  alone.id = 7;
  ASSERT_TRUE(passUntil([&] {
    alone.header = headerOf(time_, "odom");
    team.publish(alone);
    return hasVerdict(parley_msgs::Trajectory::ARRIVED) && trajectory_.last()->intent.holder == 7;
  })) << "speaks under its number";
  EXPECT_EQ(trajectory_.last()->intent.depth, 0);
  EXPECT_EQ(trajectory_.last()->intent.way.size(), 1U) << "stays where it is";

  ASSERT_TRUE(passUntil([&] {
    team.publish(bob(0.4));
    return hasVerdict(parley_msgs::Trajectory::ESCAPING);
  })) << trajectory_.last()->text;
  EXPECT_EQ(trajectory_.last()->intent.holder, 9U);
  EXPECT_EQ(trajectory_.last()->intent.depth, 1);
  EXPECT_GT(trajectory_.last()->intent.way.size(), 1U);
  EXPECT_EQ(client.getState(), actionlib::SimpleClientGoalState::SUCCEEDED) << "making room is no failure";

  EXPECT_TRUE(passUntil([&] { return hasVerdict(parley_msgs::Trajectory::ARRIVED); })) << "who is silent is not minded";
}

TEST_F(DrivingTest, PlannerRefusesTeammatesThatCannotBe) {
  const PlannerNode node(nh_, pnh("planner"), "planner");
  ros::Publisher team = nh_.advertise<parley_msgs::PeerMotions>("peer_motions", 10);
  goals_.publish(pose(0.1, 0.0, "odom"));
  ASSERT_TRUE(passUntil([this] { return hasVerdict(parley_msgs::Trajectory::ARRIVED); }));
  for (int i = 0; i < 40; ++i) {
    parley_msgs::PeerMotions message = bob(i % 4 == 0 ? -0.4 : 0.4);
    if (i % 4 == 1) message.header.frame_id = "elsewhere";
    if (i % 4 == 2) message.peers[0].intent.way[1].x = std::nan("");
    if (i % 4 == 3) message.peers[0].trajectory.clear();
    team.publish(message);
    pass();
    ASSERT_TRUE(hasVerdict(parley_msgs::Trajectory::ARRIVED)) << i << ": " << trajectory_.last()->text;
  }
}

TEST_F(DrivingTest, ControlDrivesAndStopsOnEveryWayOut) {
  const PlannerNode planner(nh_, pnh("planner"), "planner");
  {
    const ControlNode control(nh_, pnh("control"), "control");
    goals_.publish(pose(3.0, 0.0, "odom"));
    ASSERT_TRUE(passUntil([this] { return drives(); }));
    EXPECT_EQ(state_.last()->name, "driving");

    setTime(5.0);
    twist_.clear();
    pass();
    ASSERT_TRUE(passUntil([this] { return twist_.count() > 0; }));
    ASSERT_TRUE(passUntil([this] { return drives(); })) << "goes on after time has jumped back";
  }
  // The node is gone; its last word arrives.
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(5);
  while (twist_.last()->linear.x != 0.0 && std::chrono::steady_clock::now() < end) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_EQ(twist_.last()->linear.x, 0.0);
}

TEST_F(DrivingTest, ControlStandsWithoutSensorsAndSaysWhy) {
  const ControlNode control(nh_, pnh("control"), "control");
  for (int i = 0; i < 20; ++i) {
    setTime(time_ + 0.1);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  ASSERT_GT(state_.count(), 0);
  EXPECT_EQ(state_.last()->name, "no_odometry") << state_.last()->reason;
  EXPECT_EQ(twist_.last()->linear.x, 0.0);
}

TEST_F(DrivingTest, ControlRefusesHostileTrajectories) {
  const ControlNode control(nh_, pnh("control"), "control");
  ros::Publisher trajectories = nh_.advertise<parley_msgs::Trajectory>("trajectory", 1);
  ros::Publisher goals = nh_.advertise<parley_msgs::Goal>("goal", 1, true);
  parley_msgs::Goal goal;
  goal.active = true;
  goals.publish(goal);
  for (int i = 0; i < 10; ++i) {
    parley_msgs::Trajectory trajectory;
    trajectory.header.frame_id = i % 2 == 0 ? "odom" : "elsewhere";
    trajectory.header.stamp = trajectory.start = ros::Time(time_);
    trajectory.points.resize(2);
    trajectory.points[0].stamp = ros::Time(time_);
    trajectory.points[0].speed = i % 2 == 0 ? std::nan("") : 1.0;
    trajectory.points[1].stamp = ros::Time(time_ + 5.0);
    trajectory.points[1].x = 3.0;
    trajectories.publish(trajectory);
    pass();
    ASSERT_TRUE(twist_.count() == 0 || twist_.last()->linear.x == 0.0);
  }
}

TEST_F(DrivingTest, UnusableParametersAreRefused) {
  pnh("planner").setParam("goal/tolerance", -1.0);
  EXPECT_NE(refusal<PlannerNode>(nh_, pnh("planner")).find("tolerance: value -1"), std::string::npos);
  pnh("control").setParam("period", true);
  EXPECT_NE(refusal<ControlNode>(nh_, pnh("control")).find("period: must be a number"), std::string::npos);
}

}  // namespace
}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "driving_nodes_test");
  ros::NodeHandle nh;
  return RUN_ALL_TESTS();
}

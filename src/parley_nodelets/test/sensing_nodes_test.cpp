// SPDX-License-Identifier: BSD-3-Clause
#include <nav_msgs/OccupancyGrid.h>
#include <parley_msgs/Contours.h>
#include <parley_msgs/Goal.h>
#include <parley_msgs/Graph.h>
#include <parley_msgs/ObstacleScan.h>
#include <parley_msgs/PeerMaps.h>
#include <parley_msgs/Route.h>
#include <parley_msgs/Teammates.h>
#include <parley_msgs/TrackedObjects.h>
#include <visualization_msgs/MarkerArray.h>

#include "node_fixture.h"
#include "parley_nodelets/lidar_node.h"
#include "parley_nodelets/topology_node.h"

namespace parley {
namespace {

using test::Listener;
using test::refusal;

class LidarNodeTest : public test::NodeFixture {
 protected:
  Listener<parley_msgs::ObstacleScan> obstacles_{nh_, "obstacles"};
  Listener<parley_msgs::TrackedObjects> tracks_{nh_, "tracks"};
};

TEST_F(LidarNodeTest, TurnsScansIntoObstacles) {
  const LidarNode node(nh_, pnh("lidar"), "lidar");
  ASSERT_TRUE(passUntil([this] { return obstacles_.count() > 2 && tracks_.count() > 2; }));
  const auto last = obstacles_.last();
  EXPECT_EQ(last->header.frame_id, "base_link");
  EXPECT_EQ(last->ranges.size(), 720U);
  EXPECT_NEAR(last->ranges[360], 4.0, 0.05) << "straight ahead";
  EXPECT_LE(last->header.stamp, ros::Time::now());
  EXPECT_EQ(tracks_.last()->header.frame_id, "odom");
}

TEST_F(LidarNodeTest, KeepsTeammatesOffTheMapWhileTheyAreFresh) {
  const LidarNode node(nh_, pnh("lidar"), "lidar");
  ros::Publisher teammates = nh_.advertise<parley_msgs::Teammates>("teammates", 1);
  const auto isTransient = [this] { return obstacles_.count() > 0 && obstacles_.last()->transient[360] != 0; };
  parley_msgs::Teammates message;
  message.header.frame_id = "odom";
  message.teammates.resize(1);
  message.teammates[0].pose.position.x = 4.0;  // where the scan sees the wall straight ahead
  message.teammates[0].pose.orientation.w = 1.0;
  message.teammates[0].length = 0.8;
  message.teammates[0].width = 0.4;
  EXPECT_TRUE(passUntil([&] {
    message.header.stamp = ros::Time(time_);
    teammates.publish(message);
    return isTransient();
  }));
  EXPECT_TRUE(passUntil([&] { return !isTransient(); })) << "the message is old by now";
  message.teammates[0].width = -1.0;
  message.header.stamp = ros::Time(time_);
  teammates.publish(message);
  obstacles_.clear();
  EXPECT_TRUE(passUntil([&] { return obstacles_.count() > 2; }));
  EXPECT_FALSE(isTransient());
}

TEST_F(LidarNodeTest, SurvivesHostileInput) {
  const LidarNode node(nh_, pnh("lidar"), "lidar");
  ros::Publisher points = nh_.advertise<sensor_msgs::PointCloud2>("points", 10);
  ASSERT_TRUE(passUntil([this] { return obstacles_.count() > 0; }));
  sensor_msgs::LaserScan bad = roomScan(time_);
  std::fill(bad.ranges.begin(), bad.ranges.end(), std::numeric_limits<float>::quiet_NaN());
  scan_.publish(bad);
  bad.angle_increment = 0.0F;
  scan_.publish(bad);
  scan_.publish(sensor_msgs::LaserScan());
  nav_msgs::Odometry odometry = odometryAt(time_);
  odometry.pose.pose.position.x = std::nan("");
  odometry_.publish(odometry);
  odometry.pose.pose.orientation.w = 0.0;
  odometry_.publish(odometry);
  sensor_msgs::PointCloud2 cloud = toMessage(LidarCloud{time_, {{1.0F, 0.0F, 0.0F, 0.0F}}}, "lidar");
  cloud.width = 1000000;
  points.publish(cloud);
  obstacles_.clear();
  EXPECT_TRUE(passUntil([this] { return obstacles_.count() > 1; }));
}

TEST_F(LidarNodeTest, OdometryOfAnotherRobotIsNotTaken) {
  const LidarNode node(nh_, pnh("lidar"), "lidar");
  for (int i = 0; i < 10; ++i) {
    setTime(time_ + 0.1);
    nav_msgs::Odometry odometry = odometryAt(time_);
    odometry.header.frame_id = "robot_2/odom";
    odometry_.publish(odometry);
    scan_.publish(roomScan(time_));
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  EXPECT_EQ(obstacles_.count(), 0);
}

TEST_F(LidarNodeTest, GoesOnWhenTimeJumpsBack) {
  const LidarNode node(nh_, pnh("lidar"), "lidar");
  setTime(1000.0);
  ASSERT_TRUE(passUntil([this] { return obstacles_.count() > 2; }));
  setTime(5.0);
  EXPECT_TRUE(passUntil([this] { return obstacles_.count() > 0 && obstacles_.last()->header.stamp.toSec() < 100.0; }));
}

TEST_F(LidarNodeTest, RefusesUnusableParametersInOneMessage) {
  pnh("lidar").deleteParam("robot/footprint/width");
  pnh("lidar").deleteParam("frames/base");
  pnh("lidar").setParam("max_range", "far");
  pnh("lidar").setParam("bins", 2);
  pnh("lidar").setParam("voxel", 0.1);
  pnh("lidar").setParam("radio/range", 3.0);
  const std::string text = refusal<LidarNode>(nh_, pnh("lidar"));
  for (const char* part : {"width: is missing", "base: is missing", "max_range: must be a number", "bins: value 2",
                           "voxel: unknown key", "radio: unknown group"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << " is not in\n" << text;
  }
}

class TopologyNodeTest : public test::NodeFixture {
 protected:
  LidarNode lidar_{nh_, pnh("lidar"), "lidar"};
  ros::Publisher goal_{nh_.advertise<parley_msgs::Goal>("goal", 1, true)};
  Listener<nav_msgs::OccupancyGrid> map_{nh_, "local_map"};
  Listener<parley_msgs::Route> route_{nh_, "route"};
  Listener<parley_msgs::Graph> graph_{nh_, "graph"};
  Listener<visualization_msgs::MarkerArray> markers_{nh_, "topology_markers"};

  void setGoal(double x, double y, const std::string& frame) {
    parley_msgs::Goal goal;
    goal.header.frame_id = frame;
    goal.active = true;
    goal.position.x = x;
    goal.position.y = y;
    goal_.publish(goal);
  }
};

TEST_F(TopologyNodeTest, MapsAndFindsARoute) {
  const TopologyNode node(nh_, pnh("topology"), "topology");
  setGoal(3.0, 0.0, "odom");
  ASSERT_TRUE(passUntil([this] { return route_.count() > 0 && route_.last()->verdict == parley_msgs::Route::THROUGH_KNOWN; }));
  EXPECT_NEAR(route_.last()->length, 3.0, 0.2);
  EXPECT_EQ(route_.last()->goal.x, 3.0);
  ASSERT_TRUE(passUntil([this] { return map_.count() > 5 && graph_.count() > 0 && markers_.count() > 0; }));
  EXPECT_EQ(map_.last()->header.frame_id, "odom");
  EXPECT_NEAR(map_.last()->info.width * map_.last()->info.resolution, 10.0, 0.2);
  EXPECT_EQ(markers_.last()->markers.size(), 4U);
}

/// A pillar behind the wall, as another robot tells of it.
parley_msgs::PeerMaps pillarOf(const std::string& origin, double time) {
  parley_msgs::PeerMaps maps;
  maps.header.frame_id = "odom";
  maps.header.stamp = ros::Time(time);
  parley_msgs::MapLayer& layer = maps.layers.emplace_back();
  layer.origin = origin;
  layer.stamp = maps.header.stamp;
  layer.T_odom_peer.position.x = 6.0;
  layer.T_odom_peer.orientation.w = 1.0;
  layer.obstacle = 1;
  parley_msgs::Contour& contour = layer.contours.emplace_back();
  contour.closed = 1;
  for (const auto& [x, y] : std::vector<std::pair<double, double>>{{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}) {
    geometry_msgs::Point& point = contour.points.emplace_back();
    point.x = x;
    point.y = y;
  }
  return maps;
}

TEST_F(TopologyNodeTest, DrawsPeersMapsAndTakesThemAway) {
  const TopologyNode node(nh_, pnh("topology"), "topology");
  ros::Publisher peer_maps = nh_.advertise<parley_msgs::PeerMaps>("peer_maps", 1, true);
  Listener<parley_msgs::Contours> contours(nh_, "contours");
  const auto isDrawn = [this] {
    if (graph_.count() == 0) return false;
    const auto& vertices = graph_.last()->vertices;
    return std::any_of(vertices.begin(), vertices.end(), [](const auto& vertex) { return vertex.origin == "bob"; });
  };
  ASSERT_TRUE(passUntil([&] { return graph_.count() > 0; }));
  ASSERT_TRUE(passUntil([&] { return contours.count() > 0 && !contours.last()->contours.empty(); })) << "the room's walls";
  EXPECT_FALSE(isDrawn());
  peer_maps.publish(pillarOf("bob", time_));
  EXPECT_TRUE(passUntil(isDrawn));
  parley_msgs::PeerMaps none = pillarOf("bob", time_);
  none.layers.clear();
  peer_maps.publish(none);
  EXPECT_TRUE(passUntil([&] { return !isDrawn(); }));
  parley_msgs::PeerMaps bad = pillarOf("bob", time_);
  bad.layers[0].contours[0].points[1].x = std::nan("");
  peer_maps.publish(bad);
  bad = pillarOf("", time_);
  peer_maps.publish(bad);
  graph_.clear();
  EXPECT_TRUE(passUntil([&] { return graph_.count() > 3; }));
  EXPECT_FALSE(isDrawn());
}

TEST_F(TopologyNodeTest, ShutsPassagesThatThePlannerDidNotGetThrough) {
  const TopologyNode node(nh_, pnh("topology"), "topology");
  ros::Publisher passages = nh_.advertise<geometry_msgs::PointStamped>("shut_passage", 1, true);
  setGoal(0.0, 2.6, "odom");
  const auto endsAtGoal = [this] {
    if (route_.count() == 0) return false;
    const geometry_msgs::Point& end = route_.last()->points.back();
    return std::hypot(end.x, end.y - 2.6) < 0.06;  // else the goal was moved to free space
  };
  ASSERT_TRUE(passUntil([&] { return endsAtGoal() && route_.last()->verdict == parley_msgs::Route::THROUGH_KNOWN; }));
  geometry_msgs::PointStamped passage;
  passage.header.stamp = ros::Time(time_);
  passage.header.frame_id = "robot_2/odom";
  passage.point.y = 2.6;
  passages.publish(passage);
  passFor(0.5);
  EXPECT_TRUE(endsAtGoal()) << "a place in another frame";
  passage.header.frame_id = "odom";
  passages.publish(passage);
  EXPECT_TRUE(passUntil([&] { return !endsAtGoal(); }));
}

TEST_F(TopologyNodeTest, GoalOfAnotherFrameOrNotFiniteIsNoGoal) {
  const TopologyNode node(nh_, pnh("topology"), "topology");
  setGoal(3.0, 0.0, "robot_2/odom");
  ASSERT_TRUE(passUntil([this] { return map_.count() > 5; }));
  EXPECT_EQ(route_.count(), 0);
  setGoal(std::nan(""), 0.0, "odom");
  passFor(0.5);
  EXPECT_EQ(route_.count(), 0);
}

TEST_F(TopologyNodeTest, ForgetsWhenTimeJumpsBackOrOdometryDoes) {
  const TopologyNode node(nh_, pnh("topology"), "topology");
  setTime(500.0);
  ASSERT_TRUE(passUntil([this] { return map_.count() > 5; }));
  setTime(5.0);
  ASSERT_TRUE(passUntil([this] { return map_.last()->header.stamp.toSec() < 100.0; }));
  setGoal(2.0, 1.0, "odom");
  EXPECT_TRUE(passUntil([this] { return route_.count() > 0 && !route_.last()->points.empty(); }));
}

TEST_F(TopologyNodeTest, RefusesUnusableParameters) {
  pnh("topology").deleteParam("robot");
  const std::string text = refusal<TopologyNode>(nh_, pnh("topology"));
  EXPECT_NE(text.find("robot/footprint: length: is missing"), std::string::npos) << text;
}

}  // namespace
}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "sensing_nodes_test");
  ros::NodeHandle nh;
  return RUN_ALL_TESTS();
}

// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <random>

#include "parley_nodelets/map_conversions.h"
#include "parley_nodelets/sensor_conversions.h"
#include "parley_nodelets/stage_conversions.h"
#include "parley_nodelets/topology_markers.h"

namespace parley {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

TEST(Time, StaysWithinWhatRosCanHold) {
  EXPECT_EQ(toRosTime(-3.0), ros::Time(0, 0));
  EXPECT_EQ(toRosTime(std::nan("")), ros::Time(0, 0));
  EXPECT_EQ(toRosTime(12.25), ros::Time(12, 250000000));
  EXPECT_NO_THROW(toRosTime(1e300));
}

TEST(OdometryMessage, ComesBackForRandomReadings) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int i = 0; i < 200; ++i) {
    Odometry odometry;
    odometry.stamp = 1000.0 + i;
    odometry.pose = {100.0 * uniform(random), 100.0 * uniform(random), 3.1 * uniform(random)};
    odometry.twist = {uniform(random), uniform(random)};
    odometry.roll = 0.5 * uniform(random);
    odometry.pitch = 0.5 * uniform(random);
    const auto back = fromMessage(toMessage(odometry, "odom", "base_link"));
    ASSERT_TRUE(back) << i;
    EXPECT_EQ(back->stamp, odometry.stamp);
    EXPECT_EQ(back->pose.x, odometry.pose.x);
    EXPECT_NEAR(back->pose.yaw, odometry.pose.yaw, 1e-12);
    EXPECT_NEAR(back->roll, odometry.roll, 1e-12);
    EXPECT_NEAR(back->pitch, odometry.pitch, 1e-12);
    EXPECT_EQ(back->twist.turn_rate, odometry.twist.turn_rate);
  }
}

TEST(OdometryMessage, WithoutRotationIsRefused) {
  nav_msgs::Odometry message = toMessage(Odometry{}, "odom", "base_link");
  message.pose.pose.orientation.w = 0.0;
  EXPECT_FALSE(fromMessage(message));
  message.pose.pose.orientation.w = kNan;
  EXPECT_FALSE(fromMessage(message));
}

TEST(RangeScanMessage, ComesBackWithAllThatRep117Means) {
  RangeScan scan;
  scan.stamp = 5.5;
  scan.angle_min = -1.5;
  scan.angle_increment = 0.25;
  scan.time_increment = 0.125;
  scan.range_min = 0.5;
  scan.range_max = 4.0;
  scan.ranges = {1.0F, kInfinity, -kInfinity, kNan};
  const RangeScan back = fromMessage(toMessage(scan, "lidar"));
  EXPECT_EQ(back.stamp, scan.stamp);
  EXPECT_EQ(back.angle_min, scan.angle_min);
  EXPECT_EQ(back.angle_increment, scan.angle_increment);
  EXPECT_EQ(back.time_increment, scan.time_increment);
  EXPECT_EQ(back.range_max, scan.range_max);
  ASSERT_EQ(back.ranges.size(), 4U);
  EXPECT_EQ(back.ranges[1], kInfinity);
  EXPECT_EQ(back.ranges[2], -kInfinity);
  EXPECT_TRUE(std::isnan(back.ranges[3]));
}

TEST(CloudMessage, ComesBackAndRefusesWhatIsCutShort) {
  LidarCloud cloud;
  cloud.stamp = 9.0;
  cloud.points = {{1.0F, 2.0F, 3.0F, 0.01F}, {-4.0F, 5.0F, kNan, 0.02F}};
  sensor_msgs::PointCloud2 message = toMessage(cloud, "lidar");
  const auto back = fromMessage(message);
  ASSERT_TRUE(back);
  ASSERT_EQ(back->points.size(), 2U);
  EXPECT_EQ(back->points[1].x, -4.0F);
  EXPECT_TRUE(std::isnan(back->points[1].z));
  EXPECT_EQ(back->points[0].time, 0.01F);

  sensor_msgs::PointCloud2 cut = message;
  cut.data.resize(cut.data.size() - 1);
  EXPECT_FALSE(fromMessage(cut));
  sensor_msgs::PointCloud2 vast = message;
  vast.width = vast.height = vast.row_step = 0xffffffffU;
  EXPECT_FALSE(fromMessage(vast));
  sensor_msgs::PointCloud2 beyond = message;
  beyond.fields[2].offset = 14;
  EXPECT_FALSE(fromMessage(beyond));
  sensor_msgs::PointCloud2 wide = message;
  wide.point_step = 1000;
  EXPECT_FALSE(fromMessage(wide));
  message.is_bigendian = true;
  EXPECT_FALSE(fromMessage(message));
  EXPECT_FALSE(fromMessage(sensor_msgs::PointCloud2()));
}

TEST(CloudMessage, UnderstandsTheTimesThatDriversGive) {
  struct Case {
    const char* name;
    std::uint8_t type;
    double value;
  };
  for (const Case& c :
       {Case{"t", sensor_msgs::PointField::UINT32, 5e7}, Case{"offset_time", sensor_msgs::PointField::UINT32, 5e7},
        Case{"timestamp", sensor_msgs::PointField::FLOAT64, 1.7e9 + 0.05},
        Case{"timestamp", sensor_msgs::PointField::FLOAT64, (1.7e9 + 0.05) * 1e9}}) {
    sensor_msgs::PointCloud2 message = toMessage(LidarCloud{1.7e9, {{1.0F, 2.0F, 3.0F, 0.0F}}}, "lidar");
    message.fields[3].name = c.name;
    message.fields[3].datatype = c.type;
    message.fields[3].offset = 16;
    message.point_step = message.row_step = 24;
    message.data.resize(24);
    const auto whole = static_cast<std::uint32_t>(c.type == sensor_msgs::PointField::UINT32 ? c.value : 0.0);
    const void* value = c.type == sensor_msgs::PointField::UINT32 ? static_cast<const void*>(&whole) : &c.value;
    std::memcpy(message.data.data() + 16, value, c.type == sensor_msgs::PointField::UINT32 ? 4 : 8);
    const auto cloud = fromMessage(message);
    ASSERT_TRUE(cloud) << c.name;
    EXPECT_NEAR(cloud->points[0].time, 0.05, 1e-4) << c.name << " " << c.value;
  }
}

ObstacleScan someScan() {
  ObstacleScan scan;
  scan.stamp = 3.25;
  scan.range_max = 4.0;
  scan.origin = {0.2, -0.1};
  scan.ranges = {1.0F, kInfinity, kNan, 2.0F};
  scan.transient = {false, false, true, true};
  scan.moving = {false, false, false, true};
  scan.points = {{1.0F, 0.5F}};
  scan.blobs = {{{1.0, 2.0}, 0.4, 7}};
  return scan;
}

TEST(ObstacleScanMessage, ComesBack) {
  const ObstacleScan scan = someScan();
  const auto message = toMessage(scan, "base_link");
  EXPECT_EQ(message.header.frame_id, "base_link");
  const auto back = fromMessage(message);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->stamp, scan.stamp);
  EXPECT_EQ(back->origin, scan.origin);
  EXPECT_EQ(back->ranges[0], 1.0F);
  EXPECT_TRUE(std::isnan(back->ranges[2]));
  EXPECT_EQ(back->transient, scan.transient);
  EXPECT_EQ(back->moving, scan.moving);
  EXPECT_EQ(back->points, scan.points);
  ASSERT_EQ(back->blobs.size(), 1U);
  EXPECT_EQ(back->blobs[0].beams, 7);
}

TEST(ObstacleScanMessage, InconsistentOnesAreRefused) {
  auto message = toMessage(someScan(), "base_link");
  message.transient.pop_back();
  EXPECT_FALSE(fromMessage(message));
  message = toMessage(someScan(), "base_link");
  message.origin.x = kNan;
  EXPECT_FALSE(fromMessage(message));
  message = toMessage(someScan(), "base_link");
  message.points[0].x = kInfinity;
  EXPECT_FALSE(fromMessage(message));
  EXPECT_FALSE(fromMessage(parley_msgs::ObstacleScan()));
}

TEST(TracksMessage, ComesBackAndRefusesWhatIsNotFinite) {
  TrackedObject track;
  track.id = 4;
  track.stamp = 2.5;
  track.position = {1.0, 2.0};
  track.velocity = {0.5, 0.0};
  track.radius = 0.3;
  track.observations = 9;
  track.moving = track.has_moved = true;
  auto message = toMessage({track}, 2.5, "odom");
  const auto back = fromMessage(message);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->at(0).velocity, track.velocity);
  EXPECT_TRUE(back->at(0).moving);
  EXPECT_EQ(back->at(0).stamp, 2.5);
  message.objects[0].radius = kNan;
  EXPECT_FALSE(fromMessage(message));
}

LocalMap someMap() {
  LocalMap map;
  map.stamp = 8.0;
  map.frame = {{-1.5, 2.25}, 0.05, 3, 2};
  map.cells = {CellState::kUnknown,  CellState::kSeenFree, CellState::kOccupied,
               CellState::kOccupied, CellState::kUnknown,  CellState::kSeenFree};
  return map;
}

TEST(LocalMapMessage, ComesBackWithTheSameFrame) {
  const auto back = fromMessage(toMessage(someMap(), "odom"));
  ASSERT_TRUE(back);
  EXPECT_TRUE(back->frame == someMap().frame);
  EXPECT_EQ(back->cells, someMap().cells);
  EXPECT_EQ(back->stamp, 8.0);
}

TEST(LocalMapMessage, InconsistentOnesAreRefused) {
  auto message = toMessage(someMap(), "odom");
  message.info.width = 4;
  EXPECT_FALSE(fromMessage(message));
  message = toMessage(someMap(), "odom");
  message.info.resolution = 0.0F;
  EXPECT_FALSE(fromMessage(message));
  message = toMessage(someMap(), "odom");
  message.info.origin.orientation = toQuaternion(0.5);
  EXPECT_FALSE(fromMessage(message));
  EXPECT_FALSE(fromMessage(nav_msgs::OccupancyGrid()));
}

TEST(RouteMessage, ComesBackAndRefusesUnknownVerdicts) {
  RouteToGoal route;
  route.goal = {7.0, 8.0};
  route.route = {RouteVerdict::kThroughUnknown, {{0.0, 0.0}, {7.0, 8.0}}, 10.6, 12.0, 0.9, 3};
  auto message = toMessage(route, 4.0, "odom");
  const auto back = fromMessage(message);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->goal, route.goal);
  EXPECT_EQ(back->route.verdict, RouteVerdict::kThroughUnknown);
  EXPECT_EQ(back->route.points, route.route.points);
  EXPECT_EQ(back->route.narrowest, 0.9);
  EXPECT_EQ(back->route.switches, 3);
  message.verdict = 9;
  EXPECT_FALSE(fromMessage(message));
}

TEST(RobotStateMessage, ConstantsAreTheNamesOfTheStates) {
  ControlResult result;
  result.state = DriveState::kNoLidar;
  result.reason = "silent for 2 s";
  result.twist = {0.1, 0.2};
  const auto message = toMessage(result, 1.0, "base_link");
  EXPECT_EQ(message.state, parley_msgs::RobotState::NO_LIDAR);
  EXPECT_EQ(message.name, "no_lidar");
  EXPECT_EQ(message.reason, "silent for 2 s");
  EXPECT_EQ(static_cast<int>(DriveState::kDead), static_cast<int>(parley_msgs::RobotState::DEAD));
}

TEST(Graph, KeepsIdsAndIsBoundedAsMarkers) {
  VisibilityGraph graph;
  Vertex vertex;
  vertex.id = 11;
  const int a = graph.addVertex(vertex);
  vertex.id = 12;
  vertex.position = {3.0, 4.0};
  vertex.kind = VertexClass::kPillar;
  const int b = graph.addVertex(vertex);
  Edge edge;
  edge.from = a;
  edge.to = b;
  edge.length = 5.0;
  edge.clearance = 1.2;
  graph.addEdge(edge);
  const auto message = toMessage(graph, 2.0, "odom");
  ASSERT_EQ(message.vertices.size(), 2U);
  ASSERT_EQ(message.edges.size(), 1U);
  EXPECT_EQ(message.vertices[1].kind, parley_msgs::GraphVertex::PILLAR);
  EXPECT_EQ(message.edges[0].from, 11);
  EXPECT_EQ(message.edges[0].to, 12);
  EXPECT_EQ(message.edges[0].clearance, 1.2);

  Contour contour;
  contour.polygon = {{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}};
  contour.closed = true;
  const auto markers = topologyMarkers({contour, contour}, graph, Route{}, 2.0, "odom", 9);
  ASSERT_EQ(markers.markers.size(), 4U);
  EXPECT_EQ(markers.markers[0].points.size(), 8U) << "whole lines within the bound";
  EXPECT_EQ(markers.markers[3].action, visualization_msgs::Marker::DELETE) << "no route to draw";
}

}  // namespace
}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

// SPDX-License-Identifier: BSD-3-Clause
#include "parley_sim/spatial_lidar.h"

#include <gtest/gtest.h>

#include <cmath>

#include "worlds.h"

namespace parley::sim {
namespace {

LidarSpec spec(double noise = 0.0) {
  LidarSpec result;
  result.mode = LidarMode::kSpatial;
  result.noise = noise;
  result.range = 8.0;
  return result;
}

SpatialLidar lidar(const LidarSpec& s) { return {s, RandomStream(1, "r", "lidar")}; }

LidarCloud standing(SpatialLidar& device, const Pose2& pose, const Scene& scene, Attitude::Angles attitude = {}) {
  device.sweep({pose, pose, 5.0, 0.1, attitude}, scene, 0);
  return device.finish(5.0);
}

TEST(SpatialLidarTest, seesFloorAndWallsAndNoCeiling) {
  const World world = emptyWorld(10.0, 10.0);
  Scene scene;
  scene.world = &world;
  SpatialLidar device = lidar(spec());
  const LidarCloud cloud = standing(device, {4.0, 5.0, 0.3}, scene);
  ASSERT_GT(cloud.points.size(), 5000u);
  ASSERT_LT(cloud.points.size(), 20000u);
  int floor = 0;
  for (const LidarPoint& point : cloud.points) {
    const Eigen::Vector2d p = Pose2{4.0, 5.0, 0.3} * Eigen::Vector2d(point.x, point.y);
    const double height = point.z + 0.5;
    const double elevation = std::atan2(point.z, std::hypot(point.x, point.y));
    EXPECT_GT(elevation, radians(-7.01));
    EXPECT_LT(elevation, radians(52.01));
    EXPECT_LE(std::sqrt(point.x * point.x + point.y * point.y + point.z * point.z), 8.001);
    EXPECT_GE(height, -1e-4);
    EXPECT_LE(height, 2.501);
    const bool on_floor = std::abs(height) < 1e-4;
    const double to_wall = std::min({p.x(), p.y(), 10.0 - p.x(), 10.0 - p.y()});
    EXPECT_TRUE(on_floor || std::abs(to_wall) < 1e-4) << p.transpose() << " " << height;
    floor += on_floor ? 1 : 0;
  }
  EXPECT_GT(floor, 200);
}

TEST(SpatialLidarTest, looksOverRobotsAndOnTheirTops) {
  const World world = emptyWorld(60.0, 60.0);
  Scene scene;
  scene.world = &world;
  scene.boxes.push_back({boxAt({32, 30, 0}, 0.8, 0.4), kRobotHeight, 1});
  scene.boxes.push_back({boxAt({30, 30, 0}, 0.8, 0.4), kRobotHeight, 0});
  scene.discs.push_back({{{30, 32}, 0.3}, kPersonHeight, -1});
  LidarSpec high = spec();
  high.height = 0.75;
  SpatialLidar device = lidar(high);
  const LidarCloud cloud = standing(device, {30, 30, 0}, scene);
  int side = 0, top = 0, person = 0;
  for (const LidarPoint& point : cloud.points) {
    const double height = point.z + 0.75;
    const bool at_robot = point.x > 1.59 && point.x < 2.41 && std::abs(point.y) < 0.21;
    const bool at_person = std::hypot(point.x, point.y - 2.0) < 0.301;
    EXPECT_TRUE(at_robot || at_person || std::abs(height) < 1e-4);
    if (at_robot) {
      EXPECT_LT(height, 0.6001);
      ++(std::abs(height - 0.6) < 1e-4 ? top : side);
    }
    person += at_person && height > 0.6 && height < 1.7001 ? 1 : 0;
  }
  EXPECT_GT(side, 10);
  EXPECT_GT(top, 5);
  EXPECT_GT(person, 50);
}

TEST(SpatialLidarTest, pointsCarryTheirTimeAndTheMotionSinceTheFirst) {
  const World world = emptyWorld(10.0, 10.0);
  Scene scene;
  scene.world = &world;
  SpatialLidar device = lidar(spec());
  const Pose2 a{3.0, 5.0, 0.0}, b{3.1, 5.0, 0.0}, c{3.2, 5.0, 0.0};
  device.sweep({a, b, 1.0, 0.05, {}}, scene, 0);
  device.sweep({b, c, 1.05, 0.05, {}}, scene, 0);
  EXPECT_EQ(device.turnStart(), 1.0);
  const LidarCloud cloud = device.finish(7.0);
  EXPECT_EQ(cloud.stamp, 7.0);
  float last = 0.0F;
  int checked = 0;
  for (const LidarPoint& point : cloud.points) {
    EXPECT_GE(point.time, last);
    last = point.time;
    const double x = 3.0 + 2.0 * point.time + point.x;
    if (std::abs(point.z + 0.5) > 0.01 && point.x > 0 && std::abs(point.y) < 0.5 * point.x) {
      EXPECT_NEAR(x, 10.0, 2e-3);
      ++checked;
    }
  }
  EXPECT_NEAR(last, 0.1, 1e-3);
  EXPECT_GT(checked, 100);
}

TEST(SpatialLidarTest, thePatternDoesNotRepeatAndRollTiltsTheFloor) {
  const World world = emptyWorld(40.0, 40.0);
  Scene scene;
  scene.world = &world;
  SpatialLidar device = lidar(spec());
  const LidarCloud first = standing(device, {20, 20, 0}, scene), second = standing(device, {20, 20, 0}, scene);
  EXPECT_NE(first.points.front().x, second.points.front().x);
  const LidarCloud tilted = standing(device, {20, 20, 0}, scene, {0.05, 0.0});
  double slope = 0.0;
  int count = 0;
  for (const LidarPoint& point : tilted.points) {
    if (std::abs(point.y) < 1.0) continue;
    slope += (point.z + 0.5) / point.y;
    ++count;
  }
  ASSERT_GT(count, 50);
  EXPECT_NEAR(slope / count, -0.05, 0.01);
}

TEST(SpatialLidarTest, noiseIsAlongTheRay) {
  const World world = emptyWorld(10.0, 10.0);
  Scene scene;
  scene.world = &world;
  SpatialLidar device = lidar(spec(0.05));
  const LidarCloud cloud = standing(device, {5, 5, 0}, scene);
  double squares = 0.0;
  int count = 0;
  for (const LidarPoint& point : cloud.points) {
    if (point.x < 3.0 || std::abs(point.y) > 3.0 || point.z < -0.3) continue;
    const double range = Eigen::Vector3d(point.x, point.y, point.z).norm();
    const double error = range * (1.0 - 5.0 / point.x);
    squares += error * error;
    ++count;
  }
  EXPECT_NEAR(std::sqrt(squares / count), 0.05, 0.005);
}

}  // namespace
}  // namespace parley::sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

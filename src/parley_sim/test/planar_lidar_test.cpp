// SPDX-License-Identifier: BSD-3-Clause
#include "parley_sim/planar_lidar.h"

#include <gtest/gtest.h>

#include <cmath>

#include "worlds.h"

namespace parley::sim {
namespace {

LidarSpec quiet() {
  LidarSpec spec;
  spec.noise = 0.0;
  return spec;
}

PlanarLidar lidar(const LidarSpec& spec) { return {spec, RandomStream(1, "r", "lidar")}; }

/// The range in a direction of the lidar frame.
float at(const RangeScan& scan, double angle) {
  const long beam = std::lround((angle - scan.angle_min) / scan.angle_increment);
  const long count = static_cast<long>(scan.ranges.size());
  return scan.ranges[static_cast<std::size_t>(((beam % count) + count) % count)];
}

TEST(PlanarLidarTest, measuresARoomExactly) {
  const World world = emptyWorld(6.0, 4.0);
  Scene scene;
  scene.world = &world;
  const Pose2 pose{2.0, 1.5, 0.7};
  const RangeScan scan = lidar(quiet()).scan(12.5, pose, scene, 0);
  EXPECT_EQ(scan.stamp, 12.5);
  ASSERT_EQ(scan.ranges.size(), 720u);
  EXPECT_EQ(scan.range_max, 4.0);
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    const double angle = pose.yaw + scan.angle_min + static_cast<double>(i) * scan.angle_increment;
    const double dx = std::cos(angle), dy = std::sin(angle);
    const double expected = std::min(dx > 0 ? 4.0 / dx : -2.0 / dx, dy > 0 ? 2.5 / dy : -1.5 / dy);
    if (expected > 4.0) {
      EXPECT_TRUE(std::isinf(scan.ranges[i]) && scan.ranges[i] > 0) << i;
    } else {
      EXPECT_NEAR(scan.ranges[i], expected, 1e-5) << i;
    }
  }
}

TEST(PlanarLidarTest, seesBodiesAndDoorsAndNotItself) {
  const World world = emptyWorld(40.0, 40.0);
  Scene scene;
  scene.world = &world;
  scene.boxes.push_back({boxAt({20, 20, 0}, 0.8, 0.4), kRobotHeight, 0});
  scene.boxes.push_back({boxAt({22, 20, 0}, 0.8, 0.4), kRobotHeight, 1});
  scene.boxes.push_back({boxOfSegment({18, 19}, {18, 21}, 0.1), kWallHeight, -1});
  scene.discs.push_back({{{20, 23}, 0.5}, kPersonHeight, -1});
  const RangeScan scan = lidar(quiet()).scan(0.0, {20, 20, 0}, scene, 0);
  EXPECT_NEAR(at(scan, 0.0), 1.6, 1e-6);
  EXPECT_NEAR(at(scan, kPi), 1.95, 1e-6);
  EXPECT_NEAR(at(scan, kPi / 2), 2.5, 1e-6);
  EXPECT_TRUE(std::isinf(at(scan, -kPi / 2)));
  // the edges of a body: just on it and just beside it
  EXPECT_FALSE(std::isinf(at(scan, std::atan2(0.19, 1.6))));
  EXPECT_TRUE(std::isinf(at(scan, std::atan2(0.23, 1.6))));
  const RangeScan other = lidar(quiet()).scan(0.0, {22, 20, 0}, scene, 1);
  EXPECT_NEAR(at(other, kPi), 1.6, 1e-6);
}

TEST(PlanarLidarTest, mountMovesAndTurnsTheBeams) {
  const World world = emptyWorld(4.0, 4.0);
  Scene scene;
  scene.world = &world;
  LidarSpec spec = quiet();
  spec.pose = {0.5, 0.0, kPi / 2};
  const RangeScan scan = lidar(spec).scan(0.0, {1.0, 1.0, 0.0}, scene, 0);
  EXPECT_NEAR(at(scan, 0.0), 3.0, 1e-5);       // along y of the base
  EXPECT_NEAR(at(scan, -kPi / 2), 2.5, 1e-5);  // along x
}

TEST(PlanarLidarTest, tooNearIsMinusInfinityAndInsideSomethingIsToo) {
  const World world = emptyWorld(4.0, 4.0);
  Scene scene;
  scene.world = &world;
  const RangeScan scan = lidar(quiet()).scan(0.0, {0.03, 2.0, 0.0}, scene, 0);
  EXPECT_TRUE(std::isinf(at(scan, kPi)) && at(scan, kPi) < 0);
  scene.discs.push_back({{{2, 2}, 0.5}, kPersonHeight, -1});
  const RangeScan within = lidar(quiet()).scan(0.0, {2.1, 2.0, 0.0}, scene, 0);
  for (const float range : within.ranges) EXPECT_TRUE(std::isinf(range) && range < 0);
}

TEST(PlanarLidarTest, noiseHasTheAskedDeviationAndDoesNotDependOnWhatIsSeen) {
  const World world = emptyWorld(6.0, 6.0);
  Scene alone;
  alone.world = &world;
  Scene crowded = alone;
  crowded.discs.push_back({{{3, 4}, 0.3}, kPersonHeight, -1});
  LidarSpec spec;
  PlanarLidar noisy = lidar(spec), exact = lidar(quiet()), other = lidar(spec);
  double squares = 0.0;
  int count = 0, equal = 0;
  for (int round = 0; round < 20; ++round) {
    const Pose2 pose{3.0, 3.0, 0.1 * round};
    const RangeScan a = noisy.scan(0.0, pose, alone, 0), truth = exact.scan(0.0, pose, alone, 0),
                    c = other.scan(0.0, pose, crowded, 0);
    for (std::size_t i = 0; i < a.ranges.size(); ++i) {
      if (truth.ranges[i] > 3.9F) continue;
      const double error = a.ranges[i] - truth.ranges[i];
      squares += error * error;
      ++count;
      equal += a.ranges[i] == c.ranges[i] ? 1 : 0;
    }
  }
  EXPECT_NEAR(std::sqrt(squares / count), spec.noise, 0.001);
  EXPECT_GT(equal, count * 8 / 10);
}

}  // namespace
}  // namespace parley::sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

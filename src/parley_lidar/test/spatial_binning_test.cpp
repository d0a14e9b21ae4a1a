// SPDX-License-Identifier: BSD-3-Clause
#include "spatial_binning.h"

#include <gtest/gtest.h>

#include <limits>

#include "world.h"

namespace parley::test {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

BinnedScan binned(const LidarCloud& cloud, const OdometryAt& robot, const LidarMount& mount = {}, LidarOptions options = {}) {
  const double duration = durationOf(cloud, options);
  const auto motion = ScanMotion::over(recorded(robot, cloud.stamp, cloud.stamp + 0.2), cloud.stamp, duration, mount);
  return binCloud(cloud, *motion, options, kRobot, mount);
}

OdometryAt still() { return level(standing(0.0, 0.0)); }

TEST(SpatialBinning, SeesTheRoomWhileDrivingAndRocking) {
  std::mt19937 random(2);
  const World world{box({-4.0, -3.0}, {5.0, 2.5}), {}};
  const OdometryAt robot = [](double t) {
    return Odometry{t, integrateTwist({0.3, 0.2, 0.9}, 2.0, -1.5, t), {}, 0.05 * std::sin(9.0 * t), 0.08 * std::cos(7.0 * t)};
  };
  Lidar lidar;
  lidar.duration = 0.1;
  lidar.mount = {0.1, 0.05, 0.5, 0.5};
  const BinnedScan scan = binned(swept(world, robot, lidar, 0.2, 20000, random), robot, lidar.mount);
  const double end_time = 0.2 + durationOf(swept(world, robot, lidar, 0.2, 20000, random), {});
  const Pose2 end = robot(end_time).pose;
  const Pose2 eye = end * Pose2{scan.origin.x(), scan.origin.y(), 0.0};
  int seen = 0;
  for (int bin = 0; bin < 720; ++bin) {
    if (!std::isfinite(scan.ranges[static_cast<std::size_t>(bin)])) continue;
    ++seen;
    const double low = -kPi + bin * 2.0 * kPi / 720 + eye.yaw;
    double nearest = kInf, farthest = 0.0;
    for (int step = -1; step <= 5; ++step) {
      const double angle = low + step * kPi / 1440;
      const double range = cast(world.walls, {eye.x, eye.y, 1.0}, {std::cos(angle), std::sin(angle), 0.0});
      nearest = std::min(nearest, range);
      farthest = std::max(farthest, range);
    }
    ASSERT_GT(scan.ranges[static_cast<std::size_t>(bin)], nearest - 0.02) << bin;
    ASSERT_LT(scan.ranges[static_cast<std::size_t>(bin)], farthest + 0.02) << bin;
  }
  EXPECT_GT(seen, 700);
}

TEST(SpatialBinning, FloorUnderATiltedLidarIsFree) {
  std::mt19937 random(4);
  const OdometryAt tilted = [](double t) { return Odometry{t, {}, {}, 0.1, -0.15}; };
  const World world{box({-30.0, -30.0}, {30.0, 30.0}), {}};
  const BinnedScan scan = binned(swept(world, tilted, {}, 0.0, 20000, random, -30.0, 10.0), tilted);
  EXPECT_TRUE(scan.points.empty());
  for (const float range : scan.ranges) ASSERT_TRUE(std::isinf(range));
  EXPECT_GT(scan.valid, 10000);
}

TEST(SpatialBinning, OnlyTheHeightBandCounts) {
  const auto seen = [](float height) {
    return std::isfinite(binned({0.0, {{2.0F, 0.001F, height - 0.5F, 0.0F}}}, still()).ranges[360]);
  };
  EXPECT_FALSE(seen(0.05F));
  EXPECT_TRUE(seen(0.15F));
  EXPECT_TRUE(seen(1.45F));
  EXPECT_FALSE(seen(1.55F));
}

TEST(SpatialBinning, BinsWithNothingButTheRobotItselfAreUnknown) {
  const LidarPoint mast{0.2F, 0.001F, 0.1F, 0.0F}, wall_behind{2.0F, 0.001F, 0.1F, 0.0F};
  EXPECT_TRUE(std::isnan(binned({0.0, {mast}}, still()).ranges[360]));
  EXPECT_TRUE(std::isinf(binned({0.0, {mast}}, still()).ranges[350]));
  EXPECT_FLOAT_EQ(binned({0.0, {mast, wall_behind}}, still()).ranges[360], 2.0F);
}

TEST(SpatialBinning, OutsideTheViewOnlyReturnsAreKnown) {
  LidarOptions options;
  options.cloud_view = kPi / 2.0;
  const LidarMount sideways{0.0, 0.0, 0.5, kPi / 2.0};
  const BinnedScan scan = binned({0.0, {{-3.0F, 0.001F, 0.0F, 0.0F}}}, still(), sideways, options);
  EXPECT_TRUE(std::isinf(scan.ranges[540])) << "left is ahead of the lidar";
  EXPECT_TRUE(std::isnan(scan.ranges[360])) << "ahead of the robot is outside its view";
  EXPECT_EQ(std::count_if(scan.ranges.begin(), scan.ranges.end(), [](float r) { return std::isfinite(r); }), 1);
}

TEST(SpatialBinning, HostilePointsAreDroppedAndCounted) {
  const float inf = std::numeric_limits<float>::infinity();
  const LidarCloud cloud{0.0,
                         {{kNan, 0.0F, 0.0F, 0.0F},
                          {0.0F, inf, 0.0F, 0.0F},
                          {0.0F, 0.0F, -inf, 0.0F},
                          {1e30F, 1e30F, 0.0F, 0.0F},
                          {2.0F, 0.0F, 0.0F, kNan},
                          {2.0F, 0.0F, 0.0F, -0.1F},
                          {2.0F, 0.0F, 0.0F, 0.6F},
                          {0.0F, 0.0F, 0.0F, 0.0F},
                          {0.05F, 0.0F, 0.0F, 0.0F},
                          {2.0F, 0.001F, 0.0F, 0.0F}}};
  const BinnedScan scan = binned(cloud, still());
  EXPECT_EQ(scan.dropped, 9);
  EXPECT_EQ(scan.valid, 1);
  EXPECT_FLOAT_EQ(scan.ranges[360], 2.0F);
  EXPECT_EQ(durationOf(cloud, {}), 0.0);
}

TEST(SpatialBinning, LargeCloudsAreThinnedEvenly) {
  LidarOptions options;
  options.max_points = 100;
  LidarCloud cloud{0.0, {}};
  for (int i = 0; i < 1000; ++i) {
    const double angle = 2.0 * kPi * i / 1000;
    cloud.points.push_back({static_cast<float>(3.0 * std::cos(angle)), static_cast<float>(3.0 * std::sin(angle)), 0.0F, 0.0F});
  }
  EXPECT_EQ(binned(cloud, still(), {}, options).valid, 100);
}

TEST(SpatialBinning, FarReturnsProveFreeSpace) {
  LidarOptions options;
  options.max_range = 4.0;
  const BinnedScan scan = binned({0.0, {{6.0F, 0.001F, 0.0F, 0.0F}}}, still(), {}, options);
  EXPECT_TRUE(std::isinf(scan.ranges[360]));
  EXPECT_TRUE(scan.points.empty());
}

}  // namespace
}  // namespace parley::test

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

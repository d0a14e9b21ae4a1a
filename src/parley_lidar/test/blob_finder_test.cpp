// SPDX-License-Identifier: BSD-3-Clause
#include "blob_finder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "planar_binning.h"
#include "world.h"

namespace parley::test {
namespace {

BinnedScan seen(const World& world, const Lidar& lidar = {}) {
  std::mt19937 random(1);
  const OdometryAt robot = level(standing(0.0, 0.0));
  const auto motion = ScanMotion::over(recorded(robot, 0.0, 0.1), 0.0, 0.0, lidar.mount);
  return PlanarBinning({}, kRobot, lidar.mount).bin(scanned(world, robot, lidar, 0.0, random), *motion);
}

std::vector<BlobShape> blobsIn(const World& world, const Lidar& lidar = {}) { return findBlobs(seen(world, lidar), {}); }

TEST(BlobFinder, FindsAPostAllAround) {
  for (double bearing = -kPi; bearing < kPi; bearing += 0.1) {
    const Eigen::Vector2d at = 2.0 * Pose2{0.0, 0.0, bearing}.direction();
    const std::vector<BlobShape> blobs = blobsIn({{}, {{circle(0.15, 24), standing(at.x(), at.y())}}});
    ASSERT_EQ(blobs.size(), 1U) << bearing;
    EXPECT_NEAR(blobs[0].blob.chord, 0.3, 0.03) << bearing;
    EXPECT_NEAR((blobs[0].blob.position - at).norm(), 0.12, 0.04) << "its near side";
    EXPECT_NEAR(blobs[0].blob.beams, 17, 2);
    EXPECT_LE(blobs[0].radius, 0.2);
  }
}

TEST(BlobFinder, ARobotIsABlobFromAnySideAndAPillarFromNear) {
  for (double yaw = 0.0; yaw < kPi; yaw += 0.2) {
    for (const double distance : {1.0, 2.0, 3.0}) {
      const World world{box({-5.0, -5.0}, {5.0, 5.0}), {{rectangle(0.8, 0.4), standing(distance, 0.3, yaw)}}};
      EXPECT_EQ(blobsIn(world).size(), 1U) << yaw << " at " << distance;
    }
  }
}

TEST(BlobFinder, TooNarrowTooWideAndTooFewBeams) {
  EXPECT_EQ(blobsIn({{}, {{circle(0.03, 12), standing(0.8, 0.0)}}}).size(), 0U);
  EXPECT_EQ(blobsIn({{}, {{rectangle(0.3, 1.3), standing(2.0, 0.0)}}}).size(), 0U);
  EXPECT_EQ(blobsIn({{}, {{rectangle(1.5, 0.3), standing(2.0, 0.0, 0.4)}}}).size(), 0U) << "deep";
  Lidar coarse;
  coarse.beams = 120;
  EXPECT_EQ(blobsIn({{}, {{circle(0.1, 12), standing(3.0, 0.0)}}}, coarse).size(), 0U);
  EXPECT_EQ(blobsIn({{}, {{circle(0.3, 12), standing(2.0, 0.0)}}}, coarse).size(), 1U);
}

TEST(BlobFinder, WallsRoomsAndCorridorsHaveNone) {
  EXPECT_TRUE(blobsIn({{}, {{circle(3.0, 100)}}}).empty());
  EXPECT_TRUE(blobsIn({box({-3.0, -2.0}, {3.0, 2.0}), {}}).empty());
  EXPECT_TRUE(blobsIn({{{{-20.0, 0.6}, {20.0, 0.6}}, {{-20.0, -0.6}, {20.0, -0.6}}}, {}}).empty()) << "corridor";
  EXPECT_TRUE(blobsIn({}).empty());
  EXPECT_TRUE(findBlobs(BinnedScan(720), {}).empty()) << "nothing looked at";
}

/// All that is seen of a wall just within range is a short piece that follows the robot along.
TEST(BlobFinder, AWallAtTheEndOfTheRangeIsNone) {
  for (double distance = 3.8; distance < 4.0; distance += 0.01) {
    EXPECT_TRUE(blobsIn({{{{distance, -9.0}, {distance, 9.0}}}, {}}).empty()) << distance;
  }
}

TEST(BlobFinder, WhatStandsCloseToAWallIsNone) {
  const std::vector<Wall> wall{{{2.0, -9.0}, {2.0, 9.0}}};
  EXPECT_TRUE(blobsIn({wall, {{rectangle(0.1, 0.4), standing(1.93, 0.0)}}}).empty());
  EXPECT_EQ(blobsIn({wall, {{rectangle(0.1, 0.4), standing(1.5, 0.0)}}}).size(), 1U);
}

TEST(BlobFinder, AWallSeenThroughADoorwayIsNone) {
  const World world{{{{1.0, -3.0}, {1.0, -0.3}}, {{1.0, 0.3}, {1.0, 3.0}}, {{2.0, -3.0}, {2.0, 3.0}}}, {}};
  EXPECT_TRUE(blobsIn(world).empty());
}

TEST(BlobFinder, HalfHiddenIsNone) {
  const World world{{}, {{circle(0.3, 24), standing(3.0, 0.0)}, {circle(0.2, 24), standing(1.5, 0.2)}}};
  const std::vector<BlobShape> blobs = blobsIn(world);
  ASSERT_EQ(blobs.size(), 1U);
  EXPECT_NEAR(blobs[0].blob.position.x(), 1.3, 0.1) << "the near one";
}

TEST(BlobFinder, AnUnseenBinBesideIsBridgedButNotTheEdgeOfTheView) {
  BinnedScan scan = seen({{}, {{circle(0.15, 24), standing(2.0, 0.0)}}});
  const std::vector<BlobShape> whole = findBlobs(scan, {});
  ASSERT_EQ(whole.size(), 1U);
  const std::size_t last = 360 + static_cast<std::size_t>(whole[0].blob.beams) / 2;
  for (std::size_t unseen = 0; unseen < 3; ++unseen) {
    for (std::size_t bin = last + 1; bin <= last + unseen; ++bin) {
      scan.ranges[bin] = std::numeric_limits<float>::quiet_NaN();
      scan.beams[bin] = -1;
    }
    EXPECT_EQ(findBlobs(scan, {}).size(), unseen < 2 ? 1U : 0U) << unseen;
  }
}

TEST(BlobFinder, PointsAreTheReturns) {
  const std::vector<BlobShape> blobs = blobsIn({{}, {{circle(0.2, 48), standing(0.0, -2.0)}}});
  ASSERT_EQ(blobs.size(), 1U);
  EXPECT_EQ(static_cast<int>(blobs[0].points.size()), blobs[0].blob.beams);
  for (const Eigen::Vector2d& p : blobs[0].points) EXPECT_NEAR((p - Eigen::Vector2d(0.0, -2.0)).norm(), 0.2, 0.02);
}

}  // namespace
}  // namespace parley::test

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

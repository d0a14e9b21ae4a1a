// SPDX-License-Identifier: BSD-3-Clause
#include "parley_lidar/lidar_stage.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "world.h"

namespace parley::test {
namespace {

OdometryAt still() { return level(standing(0.0, 0.0)); }

LidarStage stage(const LidarMount& mount = {}) { return LidarStage({}, kRobot, mount); }

RangeScan roomScan(double stamp) {
  std::mt19937 random(1);
  return scanned({box({-2.02, -2.02}, {2.02, 2.02}), {}}, still(), {}, stamp, random);
}

TEST(LidarStage, RefusesBadConfigurationWithAllProblems) {
  LidarOptions options;
  options.bins = 3;
  options.voxel_size = -1.0;
  options.min_height = 1.6;
  try {
    LidarStage(options, Footprint{}, {0.0, 0.0, std::nan(""), 0.0});
    FAIL() << "nothing thrown";
  } catch (const std::invalid_argument& error) {
    for (const char* word : {"bins", "voxel_size", "min_height", "footprint: length", "footprint: width", "mount: z"}) {
      EXPECT_NE(std::strstr(error.what(), word), nullptr) << word << " in " << error.what();
    }
  }
}

TEST(LidarStage, SeesARoom) {
  LidarStage lidar = stage();
  const LidarResult result = lidar.process(roomScan(1.0), recorded(still(), 1.0, 1.0), {});
  ASSERT_TRUE(result.status.is(LidarCode::kOk)) << result.status.text;
  EXPECT_EQ(result.scan.stamp, 1.0);
  EXPECT_EQ(result.scan.range_max, 4.0);
  EXPECT_EQ(result.scan.binCount(), 720U);
  EXPECT_EQ(result.scan.transient.size(), 720U);
  EXPECT_EQ(std::count(result.scan.transient.begin(), result.scan.transient.end(), true), 0);
  for (std::size_t bin = 0; bin < 720; ++bin) {
    const Eigen::Vector2d p = result.scan.pointAt(bin, result.scan.ranges[bin]);
    EXPECT_NEAR(std::max(std::abs(p.x()), std::abs(p.y())), 2.02, 0.02);
  }
  EXPECT_GT(result.scan.points.size(), 200U);
  EXPECT_LE(result.scan.points.size(), 16.16 / 0.05 + 8.0) << "one point for each cell along the walls";
  for (const Eigen::Vector2f& p : result.scan.points) EXPECT_NEAR(p.cwiseAbs().maxCoeff(), 2.02F, 0.03F);
  EXPECT_EQ(result.dropped_points, 0);
}

TEST(LidarStage, SeesOutOfAUTrapThroughItsOpeningOnly) {
  std::mt19937 random(1);
  const World trap{{{{-1.0, -0.8}, {1.5, -0.8}}, {{1.5, -0.8}, {1.5, 0.8}}, {{1.5, 0.8}, {-1.0, 0.8}}}, {}};
  LidarStage lidar = stage();
  const LidarResult result = lidar.process(scanned(trap, still(), {}, 1.0, random), recorded(still(), 1.0, 1.0), {});
  for (std::size_t bin = 0; bin < 720; ++bin) {
    const double bearing = result.scan.bearingOf(bin);
    if (std::abs(std::abs(bearing) - std::atan2(0.8, -1.0)) < 0.01) continue;
    EXPECT_EQ(std::isinf(result.scan.ranges[bin]), std::abs(bearing) > std::atan2(0.8, -1.0)) << bearing;
  }
}

TEST(LidarStage, ADoorwayIsFreeBetweenItsPosts) {
  std::mt19937 random(1);
  const World world{{{{1.0, -5.0}, {1.0, -0.45}}, {{1.0, 0.45}, {1.0, 5.0}}}, {}};
  LidarStage lidar = stage();
  const LidarResult result = lidar.process(scanned(world, still(), {}, 1.0, random), recorded(still(), 1.0, 1.0), {});
  EXPECT_TRUE(std::isinf(result.scan.ranges[360]));
  for (std::size_t bin = 0; bin < 720; ++bin) {
    if (!std::isfinite(result.scan.ranges[bin])) continue;
    const Eigen::Vector2d p = result.scan.pointAt(bin, result.scan.ranges[bin]);
    EXPECT_NEAR(p.x(), 1.0, 0.02);
    EXPECT_GT(std::abs(p.y()), 0.44);
  }
}

TEST(LidarStage, StatusOfHostileScans) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const OdometryBuffer odometry = recorded(still(), 1.0, 1.0);
  LidarStage lidar = stage();
  const auto code = [&](auto change) {
    RangeScan scan = roomScan(1.0);
    change(scan);
    const LidarResult result = lidar.process(scan, odometry, {});
    EXPECT_EQ(result.status.text.empty(), result.status.is(LidarCode::kOk));
    EXPECT_EQ(result.scan.ranges.empty(), !result.status.is(LidarCode::kOk));
    return result.status.code;
  };
  EXPECT_EQ(code([](RangeScan& s) { s.ranges.clear(); }), LidarCode::kMalformed);
  EXPECT_EQ(code([](RangeScan& s) { s.angle_increment = 0.0; }), LidarCode::kMalformed);
  EXPECT_EQ(code([](RangeScan& s) { s.range_max = 0.0; }), LidarCode::kMalformed);
  EXPECT_EQ(code([&](RangeScan& s) { s.ranges.assign(720, nan); }), LidarCode::kEmpty);
  for (const double stamp : {std::nan(""), kInf, -kInf}) {
    EXPECT_EQ(code([&](RangeScan& s) { s.stamp = stamp; }), LidarCode::kBadStamp);
  }
  for (const double stamp : {-5.0, 9.0, 1e300, -1e300}) {
    EXPECT_EQ(code([&](RangeScan& s) { s.stamp = stamp; }), LidarCode::kNoOdometry) << stamp;
  }
  EXPECT_EQ(lidar.process(roomScan(1.0), OdometryBuffer(), {}).status.code, LidarCode::kNoOdometry);
  EXPECT_EQ(code([](RangeScan&) {}), LidarCode::kOk) << "what was refused left no trace";
}

TEST(LidarStage, StatusOfHostileClouds) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const OdometryBuffer odometry = recorded(still(), 1.0, 1.0);
  LidarStage lidar = stage();
  EXPECT_EQ(lidar.process(LidarCloud{1.0, {}}, odometry, {}).status.code, LidarCode::kEmpty);
  const LidarResult invalid = lidar.process(LidarCloud{1.0, {{nan, 0.0F, 0.0F, 0.0F}, {1.0F, 1.0F, 0.0F, 9.0F}}}, odometry, {});
  EXPECT_EQ(invalid.status.code, LidarCode::kEmpty);
  EXPECT_EQ(invalid.dropped_points, 2);
  EXPECT_EQ(lidar.process(LidarCloud{std::nan(""), {{1.0F, 1.0F, 0.0F, 0.0F}}}, odometry, {}).status.code, LidarCode::kBadStamp);
  const LidarResult sparse = lidar.process(LidarCloud{1.0, {{1.0F, 1.0F, 0.0F, 0.0F}, {1.0F, 1.01F, 0.0F, 0.02F}}}, odometry, {});
  EXPECT_EQ(sparse.status.code, LidarCode::kOk) << sparse.status.text;
  EXPECT_NEAR(sparse.scan.stamp, 1.02, 1e-6) << "the end of the scan";
}

TEST(LidarStage, RandomGarbageNeverBreaksIt) {
  std::mt19937 random(77);
  const double values[] = {0.0, -0.0, 1.0, -1.0, 0.05, 4.0, 1e-30, 1e30, -1e30, 1e300, kInf, -kInf, std::nan("")};
  std::uniform_int_distribution<std::size_t> pick(0, std::size(values) - 1);
  const auto any = [&] { return values[pick(random)]; };
  LidarStage lidar = stage();
  const OdometryBuffer odometry = recorded(still(), 0.0, 10.0);
  const RangeScan room = roomScan(0.0);
  int accepted = 0;
  for (int round = 0; round < 1500; ++round) {
    RangeScan scan = room;
    scan.stamp = 0.006 * round;
    LidarCloud cloud{0.006 * round + 0.003, {}};
    for (int i = 0; i < 20; ++i) scan.ranges[static_cast<std::size_t>(i) * 36] = static_cast<float>(any());
    for (int i = 0; i < 20; ++i) {
      const auto x = static_cast<float>(any()), y = static_cast<float>(any()), z = static_cast<float>(any());
      cloud.points.push_back({x, y, z, static_cast<float>(round % 2 == 0 ? 0.0 : any())});
    }
    if (round % 3 == 1) scan.angle_min = any();
    if (round % 3 == 2) scan.range_max = any();
    if (round % 5 == 1) scan.angle_increment = any();
    if (round % 7 == 1) scan.time_increment = any();
    if (round % 11 == 1) scan.stamp = any();
    const std::vector<KnownTeammate> mates{{{any(), any(), any()}, {any(), any()}, any()}};
    for (const LidarResult& result : {lidar.process(scan, odometry, mates), lidar.process(cloud, odometry, mates)}) {
      accepted += result.status.is(LidarCode::kOk) ? 1 : 0;
      for (const float range : result.scan.ranges) ASSERT_FALSE(range < 0.0F) << "round " << round;
    }
  }
  EXPECT_GT(accepted, 250);
}

TEST(LidarStage, ScansMustComeInOrderAndTimeMayStartAgain) {
  LidarStage lidar = stage();
  const OdometryBuffer odometry = recorded(still(), 0.0, 10.0);
  const auto code = [&](double stamp) { return lidar.process(roomScan(stamp), odometry, {}).status.code; };
  EXPECT_EQ(code(5.0), LidarCode::kOk);
  EXPECT_EQ(code(5.0), LidarCode::kBadStamp);
  EXPECT_EQ(code(4.5), LidarCode::kBadStamp);
  EXPECT_EQ(code(5.1), LidarCode::kOk);
  EXPECT_EQ(code(1.0), LidarCode::kOk) << "time went back";
  EXPECT_EQ(code(0.9), LidarCode::kBadStamp);
  lidar.reset();
  EXPECT_EQ(code(0.9), LidarCode::kOk);
}

TEST(LidarStage, KnownTeammatesAreMaskedNotRemoved) {
  std::mt19937 random(1);
  const World world{box({-3.0, -3.0}, {3.0, 3.0}), {{rectangle(0.8, 0.4), standing(1.5, 0.5, 0.8)}}};
  LidarStage lidar = stage();
  const OdometryBuffer odometry = recorded(still(), 0.0, 3.0);
  for (int i = 0; i < 10; ++i) {
    const double t = 0.1 * i;
    const std::vector<KnownTeammate> mates{{{1.52, 0.47, 0.83}, kRobot, 0.1}, {{std::nan(""), 0.0, 0.0}, kRobot, 0.1}};
    const LidarResult result = lidar.process(scanned(world, still(), {}, t, random), odometry, mates);
    ASSERT_EQ(result.scan.blobs.size(), 1U) << "it stays in sight of relative localisation";
    const auto bin = static_cast<std::size_t>((std::atan2(0.5, 1.5) + kPi) / (2.0 * kPi) * 720);
    EXPECT_TRUE(result.scan.transient[bin]);
    EXPECT_TRUE(std::isfinite(result.scan.ranges[bin])) << "it still blocks";
    EXPECT_EQ(std::count(result.scan.transient.begin(), result.scan.transient.end(), true), result.scan.blobs[0].beams);
    EXPECT_EQ(result.masked_points, result.scan.blobs[0].beams);
  }
}

TEST(LidarStage, ANewBlobWaitsForTheMap) {
  std::mt19937 random(1);
  const World world{box({-3.0, -3.0}, {3.0, 3.0}), {{rectangle(0.4, 0.4), standing(1.5, 0.0)}}};
  LidarStage lidar = stage();
  const OdometryBuffer odometry = recorded(still(), 0.0, 3.0);
  for (int i = 0; i < 10; ++i) {
    const LidarResult result = lidar.process(scanned(world, still(), {}, 0.1 * i, random), odometry, {});
    EXPECT_EQ(result.scan.transient[360], i < 4) << i;
    EXPECT_FALSE(result.scan.moving[360]) << "what is only too new to tell";
    EXPECT_FALSE(result.scan.transient[0]);
    ASSERT_EQ(result.tracks.size(), 1U);
    EXPECT_EQ(result.tracks[0].observations, i + 1);
    EXPECT_EQ(result.tracks[0].velocity.norm(), 0.0);
  }
}

TEST(LidarStage, SameInputsSameBits) {
  std::mt19937 random(31);
  const OdometryAt robot = level(driving({-2.0, 0.0, 0.0}, 1.5, 0.5));
  const World world{box({-4.0, -4.0}, {4.0, 4.0}), {{rectangle(0.8, 0.4), driving({1.0, 1.0, 2.0}, 1.0, 0.3)}}};
  Lidar lidar;
  lidar.duration = 0.09;
  lidar.noise = 0.02;
  LidarStage first = stage(), second = stage();
  for (int i = 0; i < 20; ++i) {
    const RangeScan scan = scanned(world, robot, lidar, 0.1 * i, random);
    const OdometryBuffer odometry = recorded(robot, 0.1 * i, 0.1 * i + 0.1);
    const LidarResult a = first.process(scan, odometry, {}), b = second.process(scan, odometry, {});
    ASSERT_EQ(std::memcmp(a.scan.ranges.data(), b.scan.ranges.data(), 720 * sizeof(float)), 0);
    ASSERT_EQ(a.scan.transient, b.scan.transient);
    ASSERT_EQ(a.scan.points, b.scan.points);
    ASSERT_EQ(a.tracks.size(), b.tracks.size());
    for (std::size_t k = 0; k < a.tracks.size(); ++k) EXPECT_EQ(a.tracks[k].position, b.tracks[k].position);
  }
}

TEST(LidarStage, CanBeMovedIntoPlace) {
  LidarStage lidar = stage();
  lidar = stage({0.2, 0.0, 0.4, 0.0});
  LidarStage other = std::move(lidar);
  const LidarResult result = other.process(roomScan(1.0), recorded(still(), 1.0, 1.0), {});
  EXPECT_NEAR(result.scan.origin.x(), 0.2, 1e-6);
}

}  // namespace
}  // namespace parley::test

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

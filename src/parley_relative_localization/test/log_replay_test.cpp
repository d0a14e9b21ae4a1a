// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "../benchmark/log_drive.h"
#include "../benchmark/log_meetings.h"
#include "../benchmark/log_view.h"

namespace parley::study {
namespace {

/// A scan of half a circle from within a square room about the origin, `half` [m] from wall to middle.
LogScan roomScan(const Pose2& pose, double half, int beams = 181) {
  const test::WallRange walls = test::segmentWorld(test::box({-half, -half}, {half, half}));
  LogScan scan;
  scan.T_map_base = pose;
  scan.angle_min = -0.5 * kPi;
  scan.angle_increment = kPi / (beams - 1);
  for (int i = 0; i < beams; ++i) {
    const double bearing = pose.yaw + scan.angle_min + i * scan.angle_increment;
    scan.ranges.push_back(static_cast<float>(walls(pose.position(), {std::cos(bearing), std::sin(bearing)}, 100.0)));
  }
  return scan;
}

std::size_t binAt(const LogView& view, double bearing) {
  return static_cast<std::size_t>((bearing + kPi) / (2.0 * kPi) * static_cast<double>(view.ranges.size()));
}

/// A log that goes along x in steps of half a metre, with wheels that say too little.
CarmenLog straightLog(int scans) {
  CarmenLog log;
  for (int i = 0; i < scans; ++i) {
    log.scans.push_back(roomScan({0.5 * i - 3.0, 0.0, 0.0}, 6.0));
    log.scans.back().way = {{0.2, 0.0, 0.0}, {0.4, 0.0, 0.0}};
  }
  return log;
}

TEST(LogView, showsTheRoomFromThePlaceAsked) {
  const LogScan scan = roomScan({-1.0, 0.0, 0.0}, 3.0);
  const LogView view = viewFrom({0.5, 0.4, 0.2}, {&scan}, 720, 8.0);
  EXPECT_NEAR(view.ranges[binAt(view, -0.2)], 2.5, 0.02);              // the wall ahead
  EXPECT_NEAR(view.ranges[binAt(view, 0.5 * kPi - 0.2)], 2.6, 0.02);   // the wall to the left
  EXPECT_TRUE(std::isnan(view.ranges[binAt(view, 0.9 * kPi - 0.2)]));  // behind the scan's half circle
  EXPECT_NEAR(view.seen_to[binAt(view, -0.2)], 2.5, 0.02);
}

TEST(LogView, knowsNothingOfWhatIsHiddenFromTheScan) {
  LogScan scan = roomScan({0.0, 0.0, 0.0}, 5.0);
  for (std::size_t i = 85; i <= 95; ++i) scan.ranges[i] = 1.0F;  // a box ahead
  const LogView view = viewFrom({0.0, 2.0, 0.0}, {&scan}, 720, 8.0);
  EXPECT_TRUE(std::isnan(view.ranges[binAt(view, std::atan2(-2.0, 2.5))]));  // behind the box
  const LogScan other = roomScan({0.0, 2.0, 0.0}, 5.0);
  const LogView both = viewFrom({0.0, 2.0, 0.0}, {&scan, &other}, 720, 8.0);
  EXPECT_FALSE(std::isnan(both.ranges[binAt(both, std::atan2(-2.0, 2.5))]));  // another scan saw it
}

TEST(LogView, freeSpaceBeyondReachIsFree) {
  const LogScan scan = roomScan({0.0, 0.0, 0.0}, 6.0);
  const LogView view = viewFrom({}, {&scan}, 720, 4.0);
  EXPECT_TRUE(std::isinf(view.ranges[binAt(view, 0.0)]));
  EXPECT_FLOAT_EQ(view.seen_to[binAt(view, 0.0)], 4.0F);
}

TEST(PaintedScan, bodyIsSeenWhereTheScanSawFreeSpace) {
  const LogScan scan = roomScan({0.0, 0.0, 0.0}, 5.0);
  const LogView view = viewFrom({}, {&scan}, 720, 8.0);
  std::mt19937 random(1);
  const test::LidarModel lidar{8.0, 720, 0.0};
  const ObstacleScan ahead = paintedScan(view, {{test::kRobot, {2.0, 0.0, 0.0}, true}}, 1.0, lidar, random);
  EXPECT_NEAR(ahead.ranges[binAt(view, 0.001)], 1.6, 1e-3);
  EXPECT_TRUE(ahead.transient[binAt(view, 0.001)]);
  ASSERT_EQ(ahead.blobs.size(), 1U);
  EXPECT_NEAR(ahead.blobs.front().chord, 0.4, 0.05);
  const ObstacleScan behind = paintedScan(view, {{test::kRobot, {-2.0, 0.0, 0.0}, true}}, 1.0, lidar, random);
  EXPECT_TRUE(behind.blobs.empty());
  const ObstacleScan outside = paintedScan(view, {{test::kRobot, {6.0, 0.0, 0.0}, true}}, 1.0, lidar, random);
  EXPECT_NEAR(outside.ranges[binAt(view, 0.001)], 5.0, 0.02);
}

TEST(LogDrive, endsWhereTheScansWereAndKeepsItsSpeed) {
  const CarmenLog log = straightLog(13);
  LogDrive drive(log, {0, 12, 6, false}, 1.0, 100.0);
  EXPECT_NEAR(drive.truth().x, -3.0, 1e-9);
  double fastest = 0.0;
  for (int i = 0; i < 150; ++i) {
    drive.step(0.1, false);
    fastest = std::max(fastest, drive.twist().speed);
  }
  EXPECT_NEAR(drive.truth().x, 3.0, 1e-9);
  EXPECT_NEAR(drive.travel(), 6.0, 1e-6);
  EXPECT_LE(fastest, 1.05);
  EXPECT_NEAR(drive.twist().speed, 0.0, 1e-9);
}

TEST(LogDrive, isAtTheMeetingWhenItShouldBe) {
  const CarmenLog log = straightLog(21);
  for (const bool backwards : {false, true}) {
    LogDrive drive(log, {0, 20, 10, backwards}, 1.0, 2.0);
    for (int i = 0; i < 20; ++i) drive.step(0.1, false);
    EXPECT_NEAR(drive.truth().x, 2.0, 0.1);
    EXPECT_NEAR(drive.twist().speed, backwards ? -1.0 : 1.0, 0.1);
    for (int i = 0; i < 20; ++i) drive.step(0.1, true);
    EXPECT_LT(drive.twist().speed * (backwards ? -1.0 : 1.0), 0.0);
  }
}

TEST(LogDrive, passesEachScanOnce) {
  const CarmenLog log = straightLog(13);
  LogDrive drive(log, {0, 12, 6, false}, 1.5, 100.0);
  int passed = 0;
  for (int i = 0; i < 150; ++i) {
    drive.step(0.1, false);
    passed += drive.passed() != nullptr ? 1 : 0;
  }
  EXPECT_EQ(passed, 12);
}

TEST(LogMeetings, findsScansThatLookAtEachOther) {
  CarmenLog log;
  log.scans.push_back(roomScan({-1.0, 0.0, 0.0}, 5.0));
  log.scans.push_back(roomScan({1.5, 0.0, kPi}, 5.0));        // faces the first
  log.scans.push_back(roomScan({1.5, 0.0, 0.0}, 5.0));        // looks away
  log.scans.push_back(roomScan({1.5, 0.0, 0.9 * kPi}, 5.0));  // faces the first, too
  const std::vector<Meeting> all = findMeetings(log, 1, 1.0, 4.0);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all.front().second, 1);
  EXPECT_EQ(findMeetings(log, 2, 1.0, 4.0).size(), 1U);
  for (float& range : log.scans.front().ranges) range = std::min(range, 2.0F);  // something between them
  EXPECT_TRUE(findMeetings(log, 1, 1.0, 4.0).empty());
}

}  // namespace
}  // namespace parley::study

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

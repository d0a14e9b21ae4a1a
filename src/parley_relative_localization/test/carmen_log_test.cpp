// SPDX-License-Identifier: BSD-3-Clause
#include "../benchmark/carmen_log.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cstdio>
#include <stdexcept>

namespace parley::study {
namespace {

const char* const kText =
    "# a comment\nPARAM robot_frontlaser_offset 0.0 nohost 0\n"
    "ODOM 9 9 0 0 0 0 0.5 host 0.5\n"
    "FLASER 3 1.0 2.0 81.9 1.5 2.5 0.5 1.5 2.5 0.5 1.0 host 1.0\n"
    "ODOM 1.5 2.5 0.5 0 0 0 0 host 0\n"
    "ODOM 1.5 2.5 1.0 0 0 0 1.1 host 1.1\n"
    "ODOM 1.5 2.5 1.5 0 0 0 1.2 host 1.2\n"
    "FLASER 4 1.0 2.0 3.0 4.0 1.6 2.5 7.0 1.6 2.5 7.0 2.0 host 2.0\n";

TEST(CarmenLog, scansWaysAndViews) {
  const CarmenLog log = parseCarmenLog("log", kText);
  ASSERT_EQ(log.scans.size(), 2U);
  EXPECT_EQ(log.malformed, 0);
  const LogScan& first = log.scans.front();
  EXPECT_EQ(first.ranges, (std::vector<float>{1.0F, 2.0F, 81.9F}));
  EXPECT_EQ(first.T_map_base, (Pose2{1.5, 2.5, 0.5}));
  EXPECT_DOUBLE_EQ(first.angle_increment, 0.5 * kPi);  // both ends
  ASSERT_EQ(first.way.size(), 2U);                     // the line with stamp 0 is a correction
  EXPECT_NEAR(first.way[0].yaw, 0.5, 1e-12);
  EXPECT_NEAR(first.way[1].yaw, 1.0, 1e-12);
  EXPECT_DOUBLE_EQ(log.scans.back().angle_increment, 0.25 * kPi);  // one end
  EXPECT_NEAR(log.scans.back().T_map_base.yaw, 7.0 - 2.0 * kPi, 1e-12);
}

TEST(CarmenLog, brokenLinesAreLeftOutAndCounted) {
  for (const char* line : {"FLASER", "FLASER 3 1.0 2.0", "FLASER -4 1", "FLASER 999999999 1", "FLASER 2 1.0 x 0 0 0 0 0 0 1 h 1",
                           "FLASER 2 1.0 1.0 nan 0 0 0 0 0 1 h 1", "ODOM 1 2", "ODOM x y z 0 0 0 1 h 1"}) {
    const CarmenLog log = parseCarmenLog("log", std::string(line) + "\n" + kText);
    EXPECT_EQ(log.scans.size(), 2U) << line;
    EXPECT_EQ(log.malformed, 1) << line;
  }
}

TEST(CarmenLog, readsWhatIsZippedAndRefusesWhatIsNot) {
  const std::string path = testing::TempDir() + "carmen_log_test.log.gz";
  const gzFile file = gzopen(path.c_str(), "wb");
  ASSERT_NE(file, nullptr);
  gzputs(file, kText);
  gzclose(file);
  const CarmenLog log = readCarmenLog(path);
  EXPECT_EQ(log.name, "carmen_log_test");
  EXPECT_EQ(log.scans.size(), 2U);
  std::remove(path.c_str());
  EXPECT_THROW(readCarmenLog(path), std::runtime_error);
  EXPECT_THROW(readCarmenLog(RELATIVE_LOCALIZATION_YAML), std::runtime_error);  // no scan in it
}

}  // namespace
}  // namespace parley::study

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

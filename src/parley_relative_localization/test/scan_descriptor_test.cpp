// SPDX-License-Identifier: BSD-3-Clause
#include "parley_relative_localization/scan_descriptor.h"

#include <gtest/gtest.h>

#include <limits>

#include "simulated_lidar.h"

namespace parley {
namespace {

PolarScan randomScan(std::mt19937& random) {
  PolarScan scan;
  scan.range_max = 0.1 * static_cast<double>(1 + random() % 255);
  std::uint8_t code = 100;
  const unsigned style = random() % 4;
  for (std::uint8_t& bin : scan.codes) {
    if (style == 0) code = static_cast<std::uint8_t>(random());
    if (style == 1 && random() % 20 == 0) code = static_cast<std::uint8_t>(random());
    if (style == 2) code = static_cast<std::uint8_t>(code + random() % 5 - 2);
    bin = code;
  }
  return scan;
}

}  // namespace

TEST(ScanDescriptor, whatIsWrittenIsRead) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 500; ++trial) {
    const PolarScan scan = randomScan(random);
    const std::vector<std::uint8_t> bytes = encodeScan(scan);
    ASSERT_LE(bytes.size(), kMaxDescriptorBytes) << trial;
    const auto read = decodeScan(bytes);
    ASSERT_TRUE(read) << trial;
    EXPECT_EQ(read->codes, scan.codes) << trial;
    EXPECT_NEAR(read->range_max, scan.range_max, 1e-9) << trial;
  }
}

TEST(ScanDescriptor, roomsTakeFewBytes) {
  std::mt19937 random(3);
  const auto walls = test::segmentWorld(test::distinctiveRoom());
  for (const Pose2& pose : {Pose2{2.0, 3.0, 0.4}, Pose2{5.0, 2.0, 2.0}, Pose2{7.5, 3.5, -1.0}}) {
    const ObstacleScan scan = test::simulatedScan(walls, {}, pose, 0.0, {}, random);
    const std::size_t size = encodeScan(polarScanOf(scan, false)).size();
    EXPECT_GT(size, 40U);
    EXPECT_LT(size, 190U);
  }
}

TEST(ScanDescriptor, hostileBytesAreRefusedOrRead) {
  std::mt19937 random(5);
  int read = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    std::vector<std::uint8_t> bytes(random() % 600);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
    read += decodeScan(bytes) ? 1 : 0;
  }
  EXPECT_LT(read, 300);  // one in 256 passes the check byte
}

TEST(ScanDescriptor, cutAndFlippedBytesAreHarmless) {
  std::mt19937 random(6);
  const std::vector<std::uint8_t> good = encodeScan(randomScan(random));
  for (std::size_t size = 0; size <= good.size(); ++size) decodeScan({good.begin(), good.begin() + static_cast<long>(size)});
  for (std::size_t i = 0; i < 8 * good.size(); ++i) {
    std::vector<std::uint8_t> bytes = good;
    bytes[i / 8] ^= static_cast<std::uint8_t>(1U << (i % 8));
    decodeScan(bytes);
  }
  EXPECT_FALSE(decodeScan({}));
  EXPECT_FALSE(decodeScan({0, 0, 0}));
  EXPECT_FALSE(decodeScan(std::vector<std::uint8_t>(kMaxDescriptorBytes + 1, 1)));
}

TEST(ScanDescriptor, binsAreThinned) {
  ObstacleScan scan;
  scan.range_max = 4.0;
  scan.ranges.assign(720, std::numeric_limits<float>::infinity());
  scan.transient.assign(720, false);
  scan.ranges[0] = 1.0F;
  scan.ranges[1] = 3.0F;  // farther than its neighbour: another surface
  scan.ranges[2] = 2.0F;
  scan.ranges[3] = 2.06F;
  scan.ranges[4] = scan.ranges[5] = std::numeric_limits<float>::quiet_NaN();
  scan.ranges[6] = scan.ranges[7] = 1.5F;
  scan.transient[6] = scan.transient[7] = true;
  const PolarScan polar = polarScanOf(scan, false);
  EXPECT_NEAR(polar.rangeAt(0), 1.0, 0.01);
  EXPECT_NEAR(polar.rangeAt(1), 2.03, 0.01);
  EXPECT_TRUE(polar.isUnknown(2));
  EXPECT_TRUE(polar.isUnknown(3));
  EXPECT_EQ(polar.codeAt(4), PolarScan::kFree);
  EXPECT_NEAR(polarScanOf(scan, true).rangeAt(3), 1.5, 0.01);
}

TEST(ScanDescriptor, coarseLidarsFillAllBins) {
  ObstacleScan scan;
  scan.range_max = 4.0;
  scan.ranges.assign(90, 2.0F);
  const PolarScan polar = polarScanOf(scan, false);
  for (int bin = 0; bin < kPolarBins; ++bin) EXPECT_TRUE(polar.isHit(bin)) << bin;
  EXPECT_EQ(PolarScan::binOf(-kPi), 0);
  EXPECT_EQ(PolarScan::binOf(PolarScan::bearingOf(123)), 123);
}

}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

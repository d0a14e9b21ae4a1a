// SPDX-License-Identifier: BSD-3-Clause
#include "outlier_removal.h"

#include <gtest/gtest.h>

#include <cmath>

#include "world.h"

namespace parley::test {
namespace {

constexpr double kDistance = 0.2;
constexpr double kMemory = 0.35;

/// Free all around, with returns at some bins.
BinnedScan scanWith(const std::vector<std::pair<int, float>>& returns, int bins = 720, int beam_width = 1) {
  BinnedScan scan(bins);
  scan.range_max = 10.0;
  scan.beam_width = beam_width;
  for (int bin = 0; bin < bins; ++bin) scan.addFree(bin);
  for (const auto& [bin, range] : returns) {
    scan.addHit(bin, range, bin / beam_width);
    const double bearing = -kPi + (bin + 0.5) * 2.0 * kPi / bins;
    scan.points.push_back({(range * Pose2{0.0, 0.0, bearing}.direction()).cast<float>(), range, bin});
  }
  return scan;
}

BinnedScan cleaned(const BinnedScan& scan, const ScanHistory& history = ScanHistory(1.0), double stamp = 1.0,
                   const Pose2& pose = {}) {
  return withoutOutliers(scan, pose, history, stamp, kDistance, kMemory);
}

TEST(OutlierRemoval, ALoneReturnIsNotBelieved) {
  for (const int bin : {0, 100, 719}) {
    const BinnedScan scan = cleaned(scanWith({{bin, 2.0F}}));
    EXPECT_TRUE(std::isnan(scan.ranges[static_cast<std::size_t>(bin)]));
    EXPECT_TRUE(scan.points.empty());
    EXPECT_EQ(scan.dropped, 1);
  }
}

TEST(OutlierRemoval, TwoNeighboursAreBelievedAlsoAcrossTheSeam) {
  for (const int bin : {0, 100, 718, 719}) {
    const BinnedScan scan = cleaned(scanWith({{bin, 2.0F}, {(bin + 1) % 720, 2.05F}}));
    EXPECT_EQ(scan.dropped, 0) << bin;
    EXPECT_EQ(scan.points.size(), 2U);
  }
}

TEST(OutlierRemoval, NeighboursFarBehindAreNoCompany) {
  const BinnedScan scan = cleaned(scanWith({{99, 3.0F}, {100, 1.0F}, {101, 3.0F}}));
  EXPECT_TRUE(std::isnan(scan.ranges[100]));
  EXPECT_EQ(scan.ranges[99], 3.0F);
  EXPECT_EQ(scan.points.size(), 2U);
}

TEST(OutlierRemoval, OneBeamSpreadOverTwoBinsIsOneBeam) {
  BinnedScan scan = scanWith({{100, 2.0F}, {101, 2.0F}}, 720, 2);
  EXPECT_EQ(cleaned(scan).dropped, 2);
  scan = scanWith({{100, 2.0F}, {101, 2.0F}, {102, 2.0F}, {103, 2.0F}}, 720, 2);
  EXPECT_EQ(cleaned(scan).dropped, 0);
}

TEST(OutlierRemoval, TwoReturnsInOneBinAreBelieved) {
  EXPECT_EQ(cleaned(scanWith({{100, 2.0F}, {100, 2.1F}})).ranges[100], 2.0F);
}

TEST(OutlierRemoval, BehindALoneReturnTheNextOneCounts) {
  const BinnedScan scan = cleaned(scanWith({{99, 3.0F}, {100, 1.0F}, {100, 3.0F}, {101, 3.0F}}));
  EXPECT_EQ(scan.ranges[100], 3.0F);
  EXPECT_EQ(scan.points.size(), 3U);
}

TEST(OutlierRemoval, AThinPostIsLateByOneScanAtMost) {
  ScanHistory history(1.0);
  const BinnedScan post = scanWith({{100, 2.0F}});
  EXPECT_TRUE(std::isnan(cleaned(post, history).ranges[100]));
  history.add(post, 1.0, {});
  EXPECT_EQ(cleaned(post, history, 1.1).ranges[100], 2.0F);
  EXPECT_TRUE(std::isnan(cleaned(post, history, 1.4).ranges[100])) << "what was seen long ago does not count";
}

TEST(OutlierRemoval, APostIsKnownAgainAfterTheRobotTurned) {
  ScanHistory history(1.0);
  history.add(scanWith({{100, 2.0F}}), 1.0, {});
  const double quarter = 0.5 * kPi;
  EXPECT_EQ(cleaned(scanWith({{640, 2.0F}}), history, 1.1, {0.0, 0.0, quarter}).dropped, 0);
  EXPECT_EQ(cleaned(scanWith({{100, 2.0F}}), history, 1.1, {0.0, 0.0, quarter}).dropped, 1);
}

/// Corridor walls are met at 5 degrees and less near the end of the range: neighbours lie a quarter of a metre apart.
TEST(OutlierRemoval, CorridorWallsStay) {
  for (const int beams : {360, 720}) {
    const int bins = beams;
    std::vector<std::pair<int, float>> returns;
    for (int bin = 0; bin < bins; ++bin) {
      const double bearing = -kPi + (bin + 0.5) * 2.0 * kPi / bins;
      const double range = 0.6 / std::abs(std::sin(bearing));
      if (range < 6.0) returns.emplace_back(bin, static_cast<float>(range));
    }
    EXPECT_EQ(cleaned(scanWith(returns, bins)).dropped, 0) << beams;
  }
}

}  // namespace
}  // namespace parley::test

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

// SPDX-License-Identifier: BSD-3-Clause
#include "binned_scan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "parley_geometry/angles.h"

namespace parley {
namespace {

TEST(BearingBins, EveryBinsCentreFallsIntoIt) {
  for (const int count : {36, 181, 360, 720, 3600}) {
    const BearingBins bins(count);
    for (int bin = 0; bin < count; ++bin) EXPECT_EQ(bins.of(-kPi + (bin + 0.5) * bins.width()), bin);
    EXPECT_EQ(bins.of(-kPi), 0);
    EXPECT_EQ(bins.of(kPi), 0) << "pi and -pi are the same bearing";
    EXPECT_EQ(bins.wrap(-1), count - 1);
    EXPECT_EQ(bins.wrap(count), 0);
  }
}

/// How many beams of a turn cover each bin.
std::vector<int> coverage(int bin_count, int beams, double first) {
  const BearingBins bins(bin_count);
  std::vector<int> covered(static_cast<std::size_t>(bin_count), 0);
  const double step = 2.0 * kPi / beams;
  for (int i = 0; i < beams; ++i) {
    const BinSpan span = binsOfBeam(bins, wrapAngle(first + i * step), step);
    for (int k = 0; k < span.count; ++k) ++covered[static_cast<std::size_t>(bins.wrap(span.first + k))];
  }
  return covered;
}

TEST(BinsOfBeam, FewerBeamsThanBinsLeaveNoStripe) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> offset(-kPi, kPi);
  for (const int beams : {45, 90, 180, 181, 359, 360, 500, 719, 720}) {
    for (int round = 0; round < 20; ++round) {
      const double first = round == 0 ? -kPi : offset(random);
      const std::vector<int> covered = coverage(720, beams, first);
      EXPECT_EQ(std::count(covered.begin(), covered.end(), 0), 0) << beams << " beams from " << first;
      EXPECT_LE(*std::max_element(covered.begin(), covered.end()), 2) << beams << " beams from " << first;
    }
  }
}

TEST(BinsOfBeam, AsManyBeamsAsBinsMeetOneToOneOnEdgesAndCentres) {
  for (const double first : {-kPi, -kPi + kPi / 720}) {
    for (const int count : coverage(720, 720, first)) EXPECT_EQ(count, 1) << first;
  }
}

TEST(BinsOfBeam, NoBeamIsLostWhenThereAreMoreThanBins) {
  const BearingBins bins(360);
  for (int i = 0; i < 2000; ++i) {
    const double bearing = wrapAngle(-kPi + i * kPi / 1000.0);
    const BinSpan span = binsOfBeam(bins, bearing, kPi / 1000.0);
    ASSERT_EQ(span.count, 1);
    ASSERT_EQ(span.first, bins.of(bearing));
  }
}

TEST(BinsOfBeam, ABeamWiderThanATurnCoversEachBinOnce) { EXPECT_EQ(binsOfBeam(BearingBins(36), 0.0, 20.0).count, 36); }

TEST(BinnedScan, KeepsNearestAndNextHit) {
  BinnedScan scan(36);
  EXPECT_TRUE(std::isnan(scan.ranges[3]));
  scan.addFree(3);
  EXPECT_TRUE(std::isinf(scan.ranges[3]));
  scan.addHit(3, 2.0F, 10);
  EXPECT_TRUE(std::isinf(scan.next_ranges[3]));
  scan.addHit(3, 3.0F, 11);
  scan.addHit(3, 1.0F, 12);
  scan.addFree(3);
  EXPECT_EQ(scan.ranges[3], 1.0F);
  EXPECT_EQ(scan.next_ranges[3], 2.0F);
  EXPECT_EQ(scan.beams[3], 12);
}

}  // namespace
}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

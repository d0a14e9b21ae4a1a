// SPDX-License-Identifier: BSD-3-Clause
#include "transient_mask.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace parley {
namespace {

ObstacleScan randomScan(std::mt19937& random) {
  std::uniform_real_distribution<float> range(0.1F, 4.0F);
  ObstacleScan scan;
  scan.range_max = 4.0;
  scan.origin = {0.2, -0.1};
  for (int bin = 0; bin < 720; ++bin) {
    const float r = range(random);
    scan.ranges.push_back(r > 3.8F   ? std::numeric_limits<float>::infinity()
                          : r > 3.6F ? std::numeric_limits<float>::quiet_NaN()
                                     : r);
  }
  return scan;
}

TEST(TransientMask, DiscPicksWhatLiesInIt) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-4.0, 4.0), size(0.05, 1.5);
  for (int round = 0; round < 200; ++round) {
    const ObstacleScan scan = randomScan(random);
    const Eigen::Vector2d center(place(random), place(random));
    const double radius = size(random);
    TransientMask mask(scan);
    mask.addDisc(center, radius);
    for (std::size_t bin = 0; bin < scan.binCount(); ++bin) {
      const bool inside = std::isfinite(scan.ranges[bin]) && (scan.pointAt(bin, scan.ranges[bin]) - center).norm() <= radius;
      ASSERT_EQ(mask.bins()[bin], inside) << "round " << round << ", bin " << bin;
    }
  }
}

TEST(TransientMask, FootprintPicksWhatLiesOnItAndCounts) {
  std::mt19937 random(12);
  std::uniform_real_distribution<double> place(-3.0, 3.0), margin(0.0, 0.5);
  const Footprint footprint{0.8, 0.4};
  for (int round = 0; round < 200; ++round) {
    const ObstacleScan scan = randomScan(random);
    const Pose2 pose{place(random), place(random), place(random)};
    const double grown = margin(random);
    const Polygon outline = footprint.polygonAt(pose, grown);
    TransientMask mask(scan);
    const int picked = mask.addFootprint(pose, footprint, grown);
    int expected = 0;
    for (std::size_t bin = 0; bin < scan.binCount(); ++bin) {
      const bool inside = std::isfinite(scan.ranges[bin]) && contains(outline, scan.pointAt(bin, scan.ranges[bin]));
      ASSERT_EQ(mask.bins()[bin], inside) << "round " << round << ", bin " << bin;
      expected += inside ? 1 : 0;
    }
    EXPECT_EQ(picked, expected);
    EXPECT_EQ(mask.addFootprint(pose, footprint, grown), 0) << "nothing is counted twice";
  }
}

TEST(TransientMask, FarAwayAndAbsurdPlacesPickNothing) {
  std::mt19937 random(13);
  const ObstacleScan scan = randomScan(random);
  TransientMask mask(scan);
  mask.addDisc({1e9, -1e9}, 0.5);
  EXPECT_EQ(mask.addFootprint({1e300, 0.0, 0.0}, {0.8, 0.4}, 0.2), 0);
  EXPECT_EQ(std::count(mask.bins().begin(), mask.bins().end(), true), 0);
}

}  // namespace
}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

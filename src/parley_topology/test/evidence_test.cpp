// SPDX-License-Identifier: BSD-3-Clause
#include "evidence.h"

#include <gtest/gtest.h>

#include <limits>

#include "test_world.h"

namespace parley {
namespace {

class Mapping {
 public:
  void add(const ObstacleScan& scan, const Pose2& pose) {
    addEvidence(map, drawScan(scan, pose, testFootprint(), options.clear_margin, options.resolution), scan.stamp, options);
  }
  bool isOccupied(double x, double y) const { return at(x, y) & kOwn; }
  bool isFree(double x, double y) const { return (at(x, y) & kSeen) && !(at(x, y) & kOwn); }
  bool isUnknown(double x, double y) const { return !(at(x, y) & kSeen); }
  bool hasCome(double x, double y) const { return (at(x, y) & kCame) == kCame; }
  int occupiedCells() const {
    int count = 0;
    for (const auto& tile : map.tiles()) {
      for (const std::uint8_t flags : tile->flags) count += flags & kOwn ? 1 : 0;
    }
    return count;
  }
  TopologyOptions options;
  TiledMap map{options.resolution, options.extent, options.max_tiles};

 private:
  std::uint8_t at(double x, double y) const { return map.flags(map.cellOf(x), map.cellOf(y)); }
};

/// A scan of 720 bins without a return.
ObstacleScan emptyScan() {
  ObstacleScan scan;
  scan.range_max = 4.0;
  scan.ranges.assign(720, std::numeric_limits<float>::infinity());
  return scan;
}

}  // namespace

TEST(Evidence, seesTheInsideOfARoom) {
  TestWorld world(6.0, 6.0);
  Mapping mapping;
  const Pose2 pose{3.0, 3.0, 0.7};
  for (int i = 0; i < 3; ++i) mapping.add(world.scan(pose), pose);
  EXPECT_TRUE(mapping.isFree(3.0, 3.0));
  EXPECT_TRUE(mapping.isFree(5.5, 3.0));
  EXPECT_TRUE(mapping.isOccupied(6.01, 3.0) || mapping.isOccupied(5.99, 3.0));
  EXPECT_TRUE(mapping.isUnknown(6.3, 3.0));
  EXPECT_TRUE(mapping.isUnknown(5.9, 6.0));  // the corner is out of range
}

TEST(Evidence, oneScanIsNotEnoughForAnObstacle) {
  TestWorld world(6.0, 6.0);
  Mapping mapping;
  const Pose2 pose{3.0, 3.0, 0.0};
  mapping.add(world.scan(pose), pose);
  EXPECT_EQ(mapping.occupiedCells(), 0);
  mapping.add(world.scan(pose), pose);
  EXPECT_GT(mapping.occupiedCells(), 200);
}

TEST(Evidence, whatIsTakenAwayIsClearedAndWhatComesIsSeen) {
  TestWorld world(6.0, 6.0);
  Mapping mapping;
  const Pose2 pose{3.0, 3.0, 0.0};
  world.setBox(4.0, 2.5, 4.2, 3.5);
  for (int i = 0; i < 50; ++i) mapping.add(world.scan(pose), pose);
  EXPECT_TRUE(mapping.isOccupied(4.02, 3.0));
  world.setBox(4.0, 2.5, 4.2, 3.5, false);
  for (int i = 0; i < 20; ++i) mapping.add(world.scan(pose), pose);
  EXPECT_TRUE(mapping.isFree(4.02, 3.0));
  for (int i = 0; i < 50; ++i) mapping.add(world.scan(pose), pose);
  world.setBox(4.0, 2.5, 4.2, 3.5);
  for (int i = 0; i < 8; ++i) mapping.add(world.scan(pose), pose);
  EXPECT_TRUE(mapping.isOccupied(4.02, 3.0));
}

TEST(Evidence, grazingRaysDoNotEraseAWall) {
  TestWorld world(20.0, 3.0);
  Mapping mapping;
  std::mt19937 random(3);
  for (double x = 2.0; x < 8.0; x += 0.1) {
    const Pose2 pose{x, 0.4, 0.0};
    mapping.add(world.noisyScan(pose, 0.02, random), pose);
  }
  const Pose2 pose{8.0, 0.4, 0.0};
  for (int i = 0; i < 300; ++i) mapping.add(world.noisyScan(pose, 0.02, random), pose);
  for (double x = 2.0; x < 8.0; x += 0.05) {
    EXPECT_TRUE(mapping.isOccupied(x, -0.01) || mapping.isOccupied(x, 0.04)) << "wall gone at " << x;
  }
}

TEST(Evidence, transientHitsClearButAreNotMapped) {
  Mapping mapping;
  ObstacleScan scan = emptyScan();
  scan.transient.assign(720, false);
  for (std::size_t i = 340; i < 380; ++i) {
    scan.ranges[i] = 2.0F;
    scan.transient[i] = true;
  }
  for (int k = 0; k < 5; ++k) mapping.add(scan, {});
  EXPECT_EQ(mapping.occupiedCells(), 0);
  EXPECT_TRUE(mapping.isFree(1.5, 0.0));
  EXPECT_TRUE(mapping.isUnknown(2.5, 0.0));
  EXPECT_TRUE(mapping.isFree(-2.5, 0.0));
}

TEST(Evidence, whatMovedUpToWhereItStandsHasCome) {
  Mapping mapping;
  ObstacleScan scan = emptyScan();
  for (std::size_t i = 340; i < 380; ++i) scan.ranges[i] = 2.03F;
  for (std::size_t i = 0; i < 20; ++i) scan.ranges[i] = 3.0F;
  for (int k = 0; k < 3; ++k) {
    scan.moving.assign(720, false);
    for (std::size_t i = 340; i < 380; ++i) scan.moving[i] = k == 0;  // afterwards it stands
    for (std::size_t i = 0; i < 20; ++i) scan.moving[i] = k == 2;     // somebody moves right before a known wall
    scan.transient = scan.moving;
    mapping.add(scan, {});
  }
  EXPECT_TRUE(mapping.isOccupied(2.02, 0.01));
  EXPECT_TRUE(mapping.hasCome(2.02, 0.01));
  EXPECT_TRUE(mapping.isOccupied(-3.0, -0.01));
  EXPECT_FALSE(mapping.hasCome(-3.0, -0.01));
}

TEST(Evidence, binsThatDidNotLookDoNothing) {
  Mapping mapping;
  ObstacleScan scan = emptyScan();
  for (std::size_t i = 300; i < 420; ++i) scan.ranges[i] = std::numeric_limits<float>::quiet_NaN();
  for (std::size_t i = 0; i < 30; ++i) scan.ranges[i] = -std::numeric_limits<float>::infinity();
  mapping.add(scan, {});
  EXPECT_TRUE(mapping.isUnknown(2.0, 0.0));
  EXPECT_TRUE(mapping.isFree(0.0, 2.0));
  EXPECT_TRUE(mapping.isUnknown(-2.0, -0.1));
}

TEST(Evidence, theRobotsOwnPlaceIsFree) {
  Mapping mapping;
  ObstacleScan scan = emptyScan();
  scan.ranges.assign(720, std::numeric_limits<float>::quiet_NaN());
  mapping.add(scan, {10.0, -5.0, 0.5 * kPi});
  EXPECT_TRUE(mapping.isFree(10.0, -4.65));
  EXPECT_TRUE(mapping.isFree(10.15, -5.0));
  EXPECT_TRUE(mapping.isUnknown(10.35, -5.0));
}

TEST(Evidence, rangesOverTheEndAreFreeUpToTheEnd) {
  Mapping mapping;
  ObstacleScan scan = emptyScan();
  scan.ranges.assign(720, 50.0F);
  for (int k = 0; k < 5; ++k) mapping.add(scan, {});
  EXPECT_EQ(mapping.occupiedCells(), 0);
  EXPECT_TRUE(mapping.isFree(3.8, 0.0));
  EXPECT_TRUE(mapping.isUnknown(4.2, 0.0));
}

TEST(Evidence, unusableScansAreTold) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(isUsable(emptyScan(), {}));
  EXPECT_FALSE(isUsable(emptyScan(), {nan, 0.0, 0.0}));
  ObstacleScan scan = emptyScan();
  scan.range_max = nan;
  EXPECT_FALSE(isUsable(scan, {}));
  scan = emptyScan();
  scan.origin.x() = nan;
  EXPECT_FALSE(isUsable(scan, {}));
  scan = emptyScan();
  scan.ranges.clear();
  EXPECT_FALSE(isUsable(scan, {}));
}

}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <random>
#include <set>

#include "parley_geometry/local_map.h"
#include "parley_geometry/scan.h"

namespace parley {
namespace {

double uniform(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

GridFrame frame() { return {{-1.3, 2.7}, 0.1, 30, 20}; }

TEST(GridFrame, everyPointIsInTheSquareOfItsCell) {
  std::mt19937 random(1);
  const GridFrame f = frame();
  for (int i = 0; i < 10000; ++i) {
    const Eigen::Vector2d p(uniform(random, -5.0, 5.0), uniform(random, -1.0, 8.0));
    const Eigen::Vector2i cell = f.cellOf(p);
    const Eigen::Vector2d off = p - f.centerOf(cell);
    ASSERT_LE(off.cwiseAbs().maxCoeff(), 0.5 * f.resolution + 1e-9) << p.transpose();
    const Eigen::Vector2d from_corner = p - f.origin;
    const bool inside =
        from_corner.x() >= 0.0 && from_corner.y() >= 0.0 && from_corner.x() < f.size().x() && from_corner.y() < f.size().y();
    ASSERT_EQ(f.contains(cell), inside) << p.transpose();
  }
}

TEST(GridFrame, cellsLeftOfAndBelowTheOriginAreNegative) {
  EXPECT_EQ(frame().cellOf({-1.35, 2.65}), Eigen::Vector2i(-1, -1));
  EXPECT_FALSE(frame().contains({-1, 0}));
  EXPECT_FALSE(frame().contains({0, -1}));
  EXPECT_FALSE(frame().contains({30, 0}));
  EXPECT_FALSE(frame().contains({0, 20}));
}

TEST(GridFrame, indicesCountEveryCellOnce) {
  const GridFrame f = frame();
  std::set<int> seen;
  for (int y = 0; y < f.height; ++y) {
    for (int x = 0; x < f.width; ++x) {
      seen.insert(f.indexOf({x, y}));
      EXPECT_EQ(f.cellOf(f.centerOf({x, y})), Eigen::Vector2i(x, y));
    }
  }
  EXPECT_EQ(seen.size(), 600u);
  EXPECT_EQ(*seen.begin(), 0);
  EXPECT_EQ(*seen.rbegin(), 599);
}

TEST(GridFrame, equalsOnlyTheSameFrame) {
  EXPECT_TRUE(frame() == frame());
  GridFrame other = frame();
  other.resolution = 0.2;
  EXPECT_FALSE(frame() == other);
  other = frame();
  other.origin.x() += 0.1;
  EXPECT_FALSE(frame() == other);
}

LocalMap map() {
  LocalMap m;
  m.frame = frame();
  m.cells.assign(600, CellState::kSeenFree);
  return m;
}

TEST(LocalMap, knowsNothingOutside) {
  LocalMap m = map();
  m.cells[static_cast<std::size_t>(m.frame.indexOf({3, 4}))] = CellState::kOccupied;
  EXPECT_EQ(m.at(Eigen::Vector2i(3, 4)), CellState::kOccupied);
  EXPECT_EQ(m.at(Eigen::Vector2i(4, 4)), CellState::kSeenFree);
  EXPECT_EQ(m.at(Eigen::Vector2d(-0.95, 3.15)), CellState::kOccupied);
  EXPECT_EQ(m.at(Eigen::Vector2d(100.0, 0.0)), CellState::kUnknown);
  EXPECT_EQ(m.at(Eigen::Vector2i(-1, 0)), CellState::kUnknown);
  EXPECT_TRUE(LocalMap{}.empty());
  EXPECT_EQ(LocalMap{}.at(Eigen::Vector2i(0, 0)), CellState::kUnknown);
}

TEST(LocalMap, consistencyIsChecked) {
  EXPECT_TRUE(isConsistent(map()));
  EXPECT_FALSE(isConsistent({}));
  LocalMap m = map();
  m.cells.pop_back();
  EXPECT_FALSE(isConsistent(m));
  for (const double resolution : {0.0, -0.1, static_cast<double>(NAN), static_cast<double>(INFINITY)}) {
    m = map();
    m.frame.resolution = resolution;
    EXPECT_FALSE(isConsistent(m)) << resolution;
  }
  m = map();
  m.frame.origin.y() = NAN;
  EXPECT_FALSE(isConsistent(m));
  m = map();
  m.frame.width = -30;
  m.frame.height = -20;
  EXPECT_FALSE(isConsistent(m)) << "the product of two negative sizes is the right count";
}

TEST(ObstacleScan, binsGoRoundOnceFromMinusPi) {
  ObstacleScan scan;
  scan.origin = {0.2, -0.1};
  scan.ranges.assign(8, 1.0F);
  EXPECT_EQ(scan.binCount(), 8u);
  EXPECT_NEAR(scan.bearingOf(0), -kPi + kPi / 8.0, 1e-12);
  EXPECT_NEAR(scan.bearingOf(7), kPi - kPi / 8.0, 1e-12);
  for (std::size_t i = 0; i < 8; ++i) {
    const Eigen::Vector2d ray = scan.pointAt(i, 2.5) - scan.origin;
    EXPECT_NEAR(ray.norm(), 2.5, 1e-12);
    EXPECT_NEAR(std::atan2(ray.y(), ray.x()), scan.bearingOf(i), 1e-12);
  }
}

}  // namespace
}  // namespace parley

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

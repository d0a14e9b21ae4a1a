// SPDX-License-Identifier: BSD-3-Clause
#include "parley_robot/contour_keys.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace parley {
namespace {

Contour box(double x, double y, int piece = 0, double side = 0.4) {
  Contour contour;
  contour.polygon = {{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}};
  contour.closed = true;
  contour.tile = {static_cast<int>(x / 3.0), static_cast<int>(y / 3.0)};
  contour.piece = piece;
  return contour;
}

}  // namespace

TEST(ContourKeys, aNewPieceInFrontShiftsNoNames) {
  ContourKeys keys;
  const std::vector<std::int64_t> before = keys.assign({box(0.5, 1.0, 0), box(2.0, 2.0, 1)});
  const std::vector<std::int64_t> after = keys.assign({box(1.0, 0.2, 0), box(0.5, 1.0, 1), box(2.0, 2.0, 2)});
  EXPECT_EQ(after[1], before[0]);
  EXPECT_EQ(after[2], before[1]);
  EXPECT_NE(after[0], before[0]);
  EXPECT_NE(after[0], before[1]);
}

TEST(ContourKeys, whatGrowsKeepsItsName) {
  ContourKeys keys;
  const std::vector<std::int64_t> before = keys.assign({box(0.5, 1.0), box(2.0, 2.0, 1), box(4.0, 1.0)});
  const std::vector<std::int64_t> after = keys.assign({box(0.5, 0.9, 0, 0.6), box(2.0, 2.0, 1), box(4.0, 1.0, 0, 0.7)});
  EXPECT_EQ(after, before);
}

TEST(ContourKeys, aNameIsOneContoursAndNotUsedAgain) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(0.0, 12.0);
  std::vector<Contour> contours;
  for (int i = 0; i < 40; ++i) contours.push_back(box(place(random), place(random), i));
  ContourKeys keys;
  std::set<std::int64_t> gone;
  std::vector<std::int64_t> before = keys.assign(contours);
  for (int round = 0; round < 50; ++round) {
    const std::size_t k = random() % contours.size();
    contours.erase(contours.begin() + static_cast<std::ptrdiff_t>(k));
    gone.insert(before[k]);
    before.erase(before.begin() + static_cast<std::ptrdiff_t>(k));
    std::vector<std::int64_t> after = keys.assign(contours);
    EXPECT_EQ(after, before);
    contours.push_back(box(place(random), place(random)));
    after = keys.assign(contours);
    EXPECT_EQ(std::set<std::int64_t>(after.begin(), after.end()).size(), contours.size());
    EXPECT_EQ(gone.count(after.back()), 0U);
    EXPECT_TRUE(std::equal(before.begin(), before.end(), after.begin()));
    before = after;
  }
}

}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

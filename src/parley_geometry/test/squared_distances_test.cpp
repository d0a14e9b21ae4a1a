// SPDX-License-Identifier: BSD-3-Clause
#include "parley_geometry/squared_distances.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace parley {
namespace {

TEST(SquaredDistances, AreThoseOfTheNearestMarkedCell) {
  std::mt19937 random(7);
  for (int round = 0; round < 60; ++round) {
    const int width = 1 + static_cast<int>(random() % 40), height = 1 + static_cast<int>(random() % 40);
    const int reach = 1 + static_cast<int>(random() % 30);
    std::vector<unsigned char> marked(static_cast<std::size_t>(width * height));
    for (unsigned char& m : marked) m = random() % (1U + static_cast<unsigned>(round) * 10U) == 0U;
    const std::vector<std::int16_t> squares = squaredDistances(marked, width, height, reach);
    ASSERT_EQ(squares.size(), marked.size());
    for (int cell = 0; cell < width * height; ++cell) {
      int least = reach * reach;
      for (int other = 0; other < width * height; ++other) {
        const int dx = other % width - cell % width, dy = other / width - cell / width;
        if (marked[static_cast<std::size_t>(other)]) least = std::min(least, dx * dx + dy * dy);
      }
      ASSERT_EQ(squares[static_cast<std::size_t>(cell)], least) << width << "x" << height << ", reach " << reach;
    }
  }
}

TEST(SquaredDistances, ReachIsBounded) {
  const std::vector<unsigned char> nothing(1000, 0);
  EXPECT_EQ(squaredDistances(nothing, 1000, 1, 500)[500], kMostReach * kMostReach);
  EXPECT_EQ(squaredDistances(nothing, 1, 1000, 500)[500], kMostReach * kMostReach);
  EXPECT_EQ(squaredDistances(nothing, 1000, 1, -3)[500], 1);
  EXPECT_TRUE(squaredDistances({}, 0, 0, 10).empty());
}

}  // namespace
}  // namespace parley

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

// SPDX-License-Identifier: BSD-3-Clause
#include "cost_spreader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

namespace parley {
namespace {

constexpr int kNone = 1000000;
using Prices = std::vector<std::uint8_t>;

struct Grid {
  int width, height;
  Prices prices;
  std::vector<int> sources;
};

Grid randomGrid(std::mt19937& random) {
  Grid grid{1 + static_cast<int>(random() % 14), 1 + static_cast<int>(random() % 14), {}, {}};
  for (int cell = 0; cell < grid.width * grid.height; ++cell) {
    grid.prices.push_back(static_cast<std::uint8_t>(random() % 4 == 0 ? 0 : 1 + random() % 2));
    grid.sources.push_back(random() % 12 == 0 ? static_cast<int>(random() % 30) : kNone);
  }
  return grid;
}

/// Bellman's recursion until nothing changes any more.
std::vector<int> relaxed(const Grid& grid, const Prices& prices, int most) {
  std::vector<int> costs = grid.sources;
  for (bool any = true; any;) {
    any = false;
    for (int cell = 0; cell < grid.width * grid.height; ++cell) {
      for (int other = 0; other < grid.width * grid.height; ++other) {
        const int dx = std::abs(cell % grid.width - other % grid.width), dy = std::abs(cell / grid.width - other / grid.width);
        const auto at = static_cast<std::size_t>(cell), from = static_cast<std::size_t>(other);
        if (std::max(dx, dy) != 1 || prices[at] == 0) continue;
        const int next = costs[from] + prices[at] * (dx + dy == 2 ? CostSpreader::kDiagonal : CostSpreader::kStraight);
        if (next > most || next >= costs[at]) continue;
        costs[at] = next;
        any = true;
      }
    }
  }
  return costs;
}

TEST(CostSpreader, CostsAreTheLeast) {
  std::mt19937 random(3);
  CostSpreader spreader;
  for (int round = 0; round < 150; ++round) {
    const Grid grid = randomGrid(random);
    const int most = static_cast<int>(random() % 200);
    EXPECT_EQ(spreader.spread(grid.sources, grid.prices, grid.width, grid.height, most), relaxed(grid, grid.prices, most));
  }
}

TEST(CostSpreader, HalfPricedCostsLieBetweenPricedAndUnpricedOnes) {
  std::mt19937 random(4);
  CostSpreader spreader;
  int cheaper = 0;
  for (int round = 0; round < 150; ++round) {
    const Grid grid = randomGrid(random);
    constexpr int kMost = 300;
    const auto priced = spreader.spread(grid.sources, grid.prices, grid.width, grid.height, kMost);
    const auto half = spreader.halfPriced(priced, grid.prices, grid.width, grid.height, kMost);
    Prices even = grid.prices;
    std::replace(even.begin(), even.end(), std::uint8_t{2}, std::uint8_t{1});
    const auto unpriced = relaxed(grid, even, kMost);
    for (std::size_t cell = 0; cell < priced.size(); ++cell) {
      ASSERT_LE(unpriced[cell], half[cell]);
      ASSERT_LE(half[cell], priced[cell]);
      cheaper += half[cell] < priced[cell];
    }
    EXPECT_EQ(spreader.halfPriced(unpriced, even, grid.width, grid.height, kMost), unpriced);
  }
  EXPECT_GT(cheaper, 100);
}

TEST(CostSpreader, HalfOfTheCostIsNotPriced) {
  constexpr int kCells = 30;
  const Prices dear(kCells, 2);
  std::vector<int> sources(kCells, kNone);
  sources[0] = 0;
  CostSpreader spreader;
  const auto priced = spreader.spread(sources, dear, kCells, 1, kNone / 1000);
  const auto half = spreader.halfPriced(priced, dear, kCells, 1, kNone / 1000);
  for (int cell = 0; cell < kCells; ++cell) {
    const int with_price = (cell + 2) / 3;  // that many of the cells cost twice as much: together as much as the others
    EXPECT_EQ(priced[static_cast<std::size_t>(cell)], 20 * cell);
    EXPECT_EQ(half[static_cast<std::size_t>(cell)], 10 * cell + 10 * with_price) << cell;
  }
}

}  // namespace
}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

namespace parley {

/// Cheapest costs from sources over a grid of eight neighbours, by Dial's algorithm: costs are small integers. Keeps its memory
/// from call to call.
class CostSpreader {
 public:
  static constexpr int kStraight = 10;  // [-] units of cost across a cell's side
  static constexpr int kDiagonal = 14;  // [-] and across its corner

  /// Costs start at `sources` and grow by units times the price of each cell entered; cells of price zero are closed. What
  /// comes to more than `most` units stays as in `sources`. Grids are width times height, row by row.
  std::vector<int> spread(const std::vector<int>& sources, const std::vector<std::uint8_t>& prices, int width, int height,
                          int most);
  /// The least of costs that `spread` gave when the last part of a way to a cell, as much as makes half of its cost, costs what
  /// it is long, whatever its price.
  std::vector<int> halfPriced(const std::vector<int>& costs, const std::vector<std::uint8_t>& prices, int width, int height,
                              int most);

 private:
  struct Label {
    int cell, unpriced;
  };
  void pad(const std::vector<int>& sources, const std::vector<std::uint8_t>& prices, int width, int height);
  std::vector<int> unpadded(int width, int height) const;
  void fillBuckets(int width, int height, int most);

  // With a rim one cell wide, whose price is zero.
  std::vector<int> costs_;
  std::vector<std::uint8_t> prices_;
  std::vector<std::vector<int>> buckets_;   // cells by cost
  std::vector<std::vector<Label>> labels_;  // by cost
  std::vector<int> least_unpriced_;         // of a cell's labels so far
};

}  // namespace parley

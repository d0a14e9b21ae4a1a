// SPDX-License-Identifier: BSD-3-Clause
#include "cost_spreader.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

namespace parley {

namespace {

constexpr int kStraight = CostSpreader::kStraight, kDiagonal = CostSpreader::kDiagonal;
constexpr std::array<int, 8> kUnits{kDiagonal, kStraight, kDiagonal, kStraight, kStraight, kDiagonal, kStraight, kDiagonal};

/// Steps to the cells beside one, in a grid with a rim.
std::array<int, 8> neighboursIn(int width) {
  const int row = width + 2;
  return {-row - 1, -row, -row + 1, -1, 1, row - 1, row, row + 1};
}

}  // namespace

void CostSpreader::pad(const std::vector<int>& sources, const std::vector<std::uint8_t>& prices, int width, int height) {
  const auto cells = static_cast<std::size_t>(width + 2) * static_cast<std::size_t>(height + 2);
  costs_.assign(cells, std::numeric_limits<int>::max());
  prices_.assign(cells, 0);
  for (int y = 0; y < height; ++y) {
    const std::ptrdiff_t from = static_cast<std::ptrdiff_t>(y) * width, to = static_cast<std::ptrdiff_t>(y + 1) * (width + 2) + 1;
    std::copy_n(sources.begin() + from, width, costs_.begin() + to);
    std::copy_n(prices.begin() + from, width, prices_.begin() + to);
  }
}

/// Cells inside a source are surrounded by it and have nowhere to spread to: they are left out.
void CostSpreader::fillBuckets(int width, int height, int most) {
  if (buckets_.size() < static_cast<std::size_t>(most + 1)) buckets_.resize(static_cast<std::size_t>(most + 1));
  for (std::vector<int>& bucket : buckets_) bucket.clear();
  const int row = width + 2;
  for (int y = 1; y <= height; ++y) {
    for (int cell = y * row + 1; cell <= y * row + width; ++cell) {
      const int* const cost = costs_.data() + cell;
      if (*cost > most) continue;
      const bool inner = cost[-1] <= *cost && cost[1] <= *cost && cost[-row] <= *cost && cost[row] <= *cost;
      if (!inner) buckets_[static_cast<std::size_t>(*cost)].push_back(cell);
    }
  }
}

std::vector<int> CostSpreader::unpadded(int width, int height) const {
  std::vector<int> costs(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y) {
    std::copy_n(costs_.begin() + static_cast<std::ptrdiff_t>(y + 1) * (width + 2) + 1, width,
                costs.begin() + static_cast<std::ptrdiff_t>(y) * width);
  }
  return costs;
}

std::vector<int> CostSpreader::spread(const std::vector<int>& sources, const std::vector<std::uint8_t>& prices, int width,
                                      int height, int most) {
  pad(sources, prices, width, height);
  fillBuckets(width, height, most);
  const std::array<int, 8> neighbours = neighboursIn(width);
  for (int level = 0; level <= most; ++level) {
    const std::vector<int>& bucket = buckets_[static_cast<std::size_t>(level)];
    for (std::size_t k = 0; k < bucket.size(); ++k) {
      const auto cell = static_cast<std::size_t>(bucket[k]);
      if (costs_[cell] != level) continue;
      for (std::size_t i = 0; i < neighbours.size(); ++i) {
        const std::size_t beside = cell + static_cast<std::size_t>(neighbours[i]);
        if (prices_[beside] == 0) continue;
        const int next = level + prices_[beside] * kUnits[i];
        if (next > most || next >= costs_[beside]) continue;
        costs_[beside] = next;
        buckets_[static_cast<std::size_t>(next)].push_back(static_cast<int>(beside));
      }
    }
  }
  return unpadded(width, height);
}

/// Of the ways to a cell those are followed that are cheapest so far for how little of them is not priced: who goes on from
/// there has all that is left to half of the cost.
std::vector<int> CostSpreader::halfPriced(const std::vector<int>& costs, const std::vector<std::uint8_t>& prices, int width,
                                          int height, int most) {
  pad(costs, prices, width, height);
  labels_.resize(static_cast<std::size_t>(most + 1));
  for (std::vector<Label>& labels : labels_) labels.clear();
  std::vector<int> priced = costs_;
  least_unpriced_.assign(costs_.size(), std::numeric_limits<int>::max());
  const std::array<int, 8> neighbours = neighboursIn(width);
  // Only where a dearer cell is beside does going on for less get anywhere sooner.
  const auto leads_on = [&](std::size_t cell) {
    return std::any_of(neighbours.begin(), neighbours.end(),
                       [&](int way) { return prices_[cell + static_cast<std::size_t>(way)] > 1; });
  };
  for (std::size_t cell = 0; cell < priced.size(); ++cell) {
    if (priced[cell] > most || !leads_on(cell)) continue;
    labels_[static_cast<std::size_t>(priced[cell])].push_back({static_cast<int>(cell), 0});
  }
  for (int level = 0; level <= most; ++level) {
    const std::vector<Label>& labels = labels_[static_cast<std::size_t>(level)];
    for (std::size_t k = 0; k < labels.size(); ++k) {
      const auto cell = static_cast<std::size_t>(labels[k].cell);
      if (labels[k].unpriced >= least_unpriced_[cell]) continue;
      least_unpriced_[cell] = labels[k].unpriced;
      costs_[cell] = std::min(costs_[cell], level);
      for (std::size_t i = 0; i < neighbours.size(); ++i) {
        const std::size_t beside = cell + static_cast<std::size_t>(neighbours[i]);
        const int next = level + kUnits[i], unpriced = labels[k].unpriced + kUnits[i];
        if (prices_[beside] == 0 || next > most || next >= priced[beside] || 2 * unpriced > next) continue;
        if (unpriced < least_unpriced_[beside]) {
          labels_[static_cast<std::size_t>(next)].push_back({static_cast<int>(beside), unpriced});
        }
      }
    }
  }
  return unpadded(width, height);
}

}  // namespace parley

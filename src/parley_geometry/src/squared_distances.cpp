// SPDX-License-Identifier: BSD-3-Clause
#include "parley_geometry/squared_distances.h"

#include <algorithm>
#include <cstddef>
#include <opencv2/core/hal/intrin.hpp>

namespace parley {

namespace {

using Lanes = cv::v_int16x8;
constexpr int kLanes = Lanes::nlanes;
constexpr int kBetweenChecks = 4;  // steps, for which it is not asked whether they are still worth it

Lanes all(int value) { return cv::v_setall_s16(static_cast<short>(value)); }

/// A grid of 16 bits with `rim` cells to the left and more to the right, so that a register fits at every place of a row.
struct PaddedGrid {
  PaddedGrid(int width, int height, int rim_cells, int fill)
      : rim(rim_cells),
        stride(2 * rim + (width + kLanes - 1) / kLanes * kLanes),
        cells(static_cast<std::size_t>(stride) * static_cast<std::size_t>(height), static_cast<short>(fill)) {}
  short* row(int y) { return cells.data() + static_cast<std::ptrdiff_t>(y) * stride + rim; }

  int rim, stride;
  std::vector<short> cells;
};

/// Distances along columns, squared, from the marked cells: these are 0 in the grid, others not less than `reach`.
void measureColumns(PaddedGrid& grid, int width, int height, int reach) {
  for (int x = 0; x < width; x += kLanes) {
    Lanes distance = all(reach);
    const auto passOn = [&](const short* at) {
      distance = cv::v_min(cv::v_load(at), cv::v_min(cv::v_add_wrap(distance, all(1)), all(reach)));
    };
    for (int y = 0; y < height; ++y) {
      passOn(grid.row(y) + x);
      cv::v_store(grid.row(y) + x, distance);
    }
    for (int y = height - 1; y >= 0; --y) {
      passOn(grid.row(y) + x);
      cv::v_store(grid.row(y) + x, cv::v_mul_wrap(distance, distance));
    }
  }
}

/// The least, over the cells of a row that are less than `reach` away, of their value and the square of the way there.
Lanes leastAround(const short* at, int reach) {
  Lanes least = cv::v_load(at);
  for (int k = 1; k < reach;) {
    if (!cv::v_check_any(least > all(k * k))) break;  // nothing further off lowers any of them
    for (const int last = std::min(k + kBetweenChecks, reach); k < last; ++k) {
      const Lanes beside = cv::v_min(cv::v_load(at - k), cv::v_load(at + k));
      least = cv::v_min(least, cv::v_add_wrap(beside, all(k * k)));
    }
  }
  return least;
}

}  // namespace

std::vector<std::int16_t> squaredDistances(const std::vector<unsigned char>& marked, int width, int height, int reach) {
  reach = std::clamp(reach, 1, kMostReach);
  PaddedGrid grid(width, height, reach, reach * reach);
  for (int y = 0; y < height; ++y) {
    const auto from = marked.begin() + static_cast<std::ptrdiff_t>(y) * width;
    std::transform(from, from + width, grid.row(y), [&](unsigned char m) { return static_cast<short>(m ? 0 : reach); });
  }
  measureColumns(grid, width, height, reach);
  std::vector<std::int16_t> squares(marked.size());
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; x += kLanes) {
      short least[kLanes];
      cv::v_store(least, leastAround(grid.row(y) + x, reach));
      std::copy_n(least, std::min(kLanes, width - x), squares.begin() + static_cast<std::ptrdiff_t>(y) * width + x);
    }
  }
  return squares;
}

}  // namespace parley

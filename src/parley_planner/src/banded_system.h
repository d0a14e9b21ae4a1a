// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace parley {

/// Symmetric positive definite linear system whose non-zeros lie within `kBand` of the diagonal.
template <int kBand>
class BandedSystem {
 public:
  explicit BandedSystem(std::size_t size) : rows_(size), right_(size, 0.0) {
    for (auto& row : rows_) row.fill(0.0);
  }

  std::size_t size() const { return rows_.size(); }
  /// Adds to the entry at (i, j) and, by symmetry, (j, i); i <= j <= i + kBand.
  void add(std::size_t i, std::size_t j, double value) { rows_[i][j - i] += value; }
  void addRight(std::size_t i, double value) { right_[i] += value; }

  /// Solution by L D L^T in place: about kBand^2 operations a row.
  std::vector<double> solve() && {
    const std::size_t n = rows_.size();
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t reach = std::min<std::size_t>(kBand, n - 1 - i);
      for (std::size_t a = 1; a <= reach; ++a) {
        const double factor = rows_[i][a] / rows_[i][0];
        for (std::size_t b = a; b <= reach; ++b) rows_[i + a][b - a] -= factor * rows_[i][b];
        right_[i + a] -= factor * right_[i];
      }
    }
    for (std::size_t i = n; i-- > 0;) {
      const std::size_t reach = std::min<std::size_t>(kBand, n - 1 - i);
      for (std::size_t a = 1; a <= reach; ++a) right_[i] -= rows_[i][a] * right_[i + a];
      right_[i] /= rows_[i][0];
    }
    return std::move(right_);
  }

 private:
  std::vector<std::array<double, kBand + 1>> rows_;  // upper band: [i][k] is (i, i + k)
  std::vector<double> right_;
};

}  // namespace parley

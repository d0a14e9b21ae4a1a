// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace parley {

constexpr int kMostCliqueNodes = 64;  // [-]

/// Largest set of nodes that are all joined to each other, exactly (Bron and Kerbosch 1973, with pivots); of equal ones the
/// first in lexicographic order of the search. `joined` is symmetric, with at most kMostCliqueNodes nodes.
std::vector<int> maximumClique(const std::vector<std::vector<bool>>& joined);

}  // namespace parley

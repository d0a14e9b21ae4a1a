// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

namespace parley::sim {

/// For each cell of a grid with one solid cell put around it: distance from its centre to the nearest solid cell's
/// centre, in cells, exact. Row-major, (width + 2) * (height + 2) values.
std::vector<float> cellGaps(int width, int height, const std::vector<std::uint8_t>& solid);

}  // namespace parley::sim

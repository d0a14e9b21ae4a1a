// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

namespace parley {

constexpr int kMostReach = 125;  // [cells] twice its square fits into 16 bits

/// Squared distance [cells^2] from the centre of each cell of a grid, row by row, to that of the nearest marked one, exactly;
/// `reach` squared where there is none nearer than `reach` [cells], which is clamped to [1, kMostReach].
///
/// The separable minimum of Saito and Toriwaki (1994), along columns and then along rows. The reach bounds it, so that it goes
/// over all columns and rows in vector registers: for short reaches faster than algorithms of linear time.
std::vector<std::int16_t> squaredDistances(const std::vector<unsigned char>& marked, int width, int height, int reach);

}  // namespace parley

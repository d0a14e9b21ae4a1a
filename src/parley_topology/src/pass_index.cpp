// SPDX-License-Identifier: BSD-3-Clause
#include "pass_index.h"

#include "square_walk.h"

namespace parley {

std::vector<std::uint64_t> PassIndex::placesAlong(const Eigen::Vector2d& a, const Eigen::Vector2d& b) const {
  constexpr int kEverywhere = 1 << 20;  // [tiles]
  std::vector<std::uint64_t> places;
  SquareWalk walk(a / side_, (b - a) / side_, 0.0, {-kEverywhere, -kEverywhere, kEverywhere, kEverywhere});
  do places.push_back(keyOf(walk.x(), walk.y()));
  while (walk.advance(1.0));
  return places;
}

}  // namespace parley

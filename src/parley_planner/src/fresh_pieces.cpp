// SPDX-License-Identifier: BSD-3-Clause
#include "fresh_pieces.h"

#include <algorithm>
#include <cmath>

#include "parley_geometry/polygon.h"

namespace parley {

namespace {

constexpr std::size_t kLeastReturns = 3;
constexpr std::size_t kWallReturns = 12;  // known ones that tell where a wall goes, at most
constexpr double kLeastWall = 0.12;       // [m] their chord, at least
constexpr double kWallThickness = 0.07;   // [m] returns so far off a line are on it: noise
constexpr double kNoise = 0.05;           // [m] by which neighbours on a wall may be further apart than they should
constexpr double kWallDirection = 0.15;   // [-] and so much more a metre, for what the short line does not tell

using Returns = std::vector<DatedReturn>;

/// Whether returns [begin, end) lie on the line from `from` through `to`.
bool continues(const Returns& returns, std::size_t begin, std::size_t end, const Eigen::Vector2d& from,
               const Eigen::Vector2d& to) {
  const double length = (to - from).norm();
  if (length < kLeastWall) return false;
  const Eigen::Vector2d along = (to - from) / length;
  return std::all_of(returns.begin() + static_cast<std::ptrdiff_t>(begin), returns.begin() + static_cast<std::ptrdiff_t>(end),
                     [&](const DatedReturn& r) {
                       const Eigen::Vector2d offset = r.point - to;
                       return std::abs(cross(along, offset)) < kWallThickness + kWallDirection * offset.norm();
                     });
}

/// The last known return of the same thing after `i` (before it if not `forward`), at most kWallReturns away; `i` if none.
std::size_t knownUntil(const Returns& returns, std::size_t i, bool forward, double jump) {
  std::size_t k = i;
  for (std::size_t n = 0; n < kWallReturns; ++n) {
    if (forward ? k + 1 >= returns.size() : k == 0) break;
    const std::size_t next = forward ? k + 1 : k - 1;
    if (returns[next].fresh || std::abs(returns[next].range - returns[k].range) > jump) break;
    k = next;
  }
  return k;
}

/// Whether there is no more room between `known`, the last return of a wall, and `fresh` than between its returns: the front
/// of a robot that comes out of an opening may be in line with the wall beside it.
bool adjoins(const Returns& returns, std::size_t known, std::size_t known_before, std::size_t fresh) {
  const double spacing = (returns[known].point - returns[known_before].point).norm();
  return (returns[fresh].point - returns[known].point).norm() < 2.0 * spacing + kNoise;
}

/// Whether `nearer` is right beside `other` and before it.
bool hides(const DatedReturn& nearer, const DatedReturn& other) {
  return std::abs(nearer.bin - other.bin) <= 2 && nearer.range < other.range;
}

bool isRestOfWall(const Returns& returns, std::size_t begin, std::size_t end, double jump) {
  const std::size_t before = knownUntil(returns, begin, false, jump), after = knownUntil(returns, end - 1, true, jump);
  const bool goes_on_after = before + 1 < begin && adjoins(returns, begin - 1, begin - 2, begin) &&
                             continues(returns, begin, end, returns[before].point, returns[begin - 1].point);
  const bool goes_on_before = after > end && adjoins(returns, end, end + 1, end - 1) &&
                              continues(returns, begin, end, returns[after].point, returns[end].point);
  return goes_on_after || goes_on_before;
}

}  // namespace

std::vector<FreshPiece> emergingPieces(const std::vector<DatedReturn>& returns, double longest, double jump) {
  std::vector<FreshPiece> pieces;
  for (std::size_t begin = 0; begin < returns.size();) {
    std::size_t end = begin + 1;
    bool all_young = returns[begin].young;
    while (end < returns.size() && std::abs(returns[end].range - returns[end - 1].range) <= jump) {
      all_young = all_young && returns[end].young;
      ++end;
    }
    const Eigen::Vector2d &first = returns[begin].point, &last = returns[end - 1].point;
    const double chord = (last - first).norm();
    const bool is_hidden = (begin > 0 && hides(returns[begin - 1], returns[begin])) ||
                           (end < returns.size() && hides(returns[end], returns[end - 1]));
    if (all_young && is_hidden && end - begin >= kLeastReturns && chord < longest)
      pieces.push_back({0.5 * (first + last), chord});
    begin = end;
  }
  return pieces;
}

std::vector<FreshPiece> freshPieces(const std::vector<DatedReturn>& returns, double longest, double jump) {
  std::vector<FreshPiece> pieces;
  for (std::size_t begin = 0; begin < returns.size();) {
    std::size_t end = begin + 1;
    if (returns[begin].fresh) {
      while (end < returns.size() && returns[end].fresh && std::abs(returns[end].range - returns[end - 1].range) <= jump) ++end;
      const Eigen::Vector2d &first = returns[begin].point, &last = returns[end - 1].point;
      const double chord = (last - first).norm();
      if (end - begin >= kLeastReturns && chord < longest && !isRestOfWall(returns, begin, end, jump)) {
        pieces.push_back({0.5 * (first + last), chord});
      }
    }
    begin = end;
  }
  return pieces;
}

}  // namespace parley

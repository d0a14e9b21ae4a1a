// SPDX-License-Identifier: BSD-3-Clause
#include "parley_robot/contour_keys.h"

#include <algorithm>
#include <limits>

namespace parley {
namespace {

constexpr std::int64_t kNone = -1;

Eigen::Vector2d middleOf(const Polygon& polygon) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& corner : polygon) sum += corner;
  return polygon.empty() ? sum : Eigen::Vector2d(sum / static_cast<double>(polygon.size()));
}

bool isSame(const Contour& a, const Contour& b) { return a.closed == b.closed && a.hole == b.hole && a.polygon == b.polygon; }

}  // namespace

ContourKeys::Named* ContourKeys::nearest(const Contour& contour) {
  const auto tile = last_.find(tileOf(contour));
  if (tile == last_.end()) return nullptr;
  const Eigen::Vector2d middle = middleOf(contour.polygon);
  double least = std::numeric_limits<double>::infinity();
  Named* found = nullptr;
  for (Named& named : tile->second) {
    if (named.taken || named.contour.hole != contour.hole) continue;
    const double distance = (middleOf(named.contour.polygon) - middle).norm();
    if (distance >= least) continue;
    least = distance;
    found = &named;
  }
  return found;
}

std::vector<std::int64_t> ContourKeys::assign(const std::vector<Contour>& contours) {
  std::vector<std::int64_t> keys(contours.size(), kNone);
  for (std::size_t i = 0; i < contours.size(); ++i) {
    const auto tile = last_.find(tileOf(contours[i]));
    if (tile == last_.end()) continue;
    const auto same = std::find_if(tile->second.begin(), tile->second.end(),
                                   [&](const Named& named) { return !named.taken && isSame(named.contour, contours[i]); });
    if (same == tile->second.end()) continue;
    same->taken = true;
    keys[i] = same->key;
  }
  for (std::size_t i = 0; i < contours.size(); ++i) {
    if (keys[i] != kNone) continue;
    Named* named = nearest(contours[i]);
    if (named != nullptr) named->taken = true;
    keys[i] = named != nullptr ? named->key : next_++;
  }
  last_.clear();
  for (std::size_t i = 0; i < contours.size(); ++i) last_[tileOf(contours[i])].push_back({keys[i], contours[i], false});
  return keys;
}

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#include "point_index.h"

#include <algorithm>
#include <cmath>

namespace parley {
namespace {

constexpr double kAlike = 0.7;       // [-] cosine of 45 degrees
constexpr long kMostCells = 250000;  // [-] a submap larger than that gets coarser buckets

}  // namespace

PointIndex::PointIndex(std::vector<SurfacePoint> points, double cell) : cell_(cell) {
  if (points.empty()) return;
  Eigen::Vector2d high = points.front().position;
  low_ = high;
  for (const SurfacePoint& point : points) {
    low_ = low_.cwiseMin(point.position);
    high = high.cwiseMax(point.position);
  }
  const Eigen::Vector2d size = high - low_;
  while ((size.x() / cell_ + 1.0) * (size.y() / cell_ + 1.0) > static_cast<double>(kMostCells)) cell_ *= 2.0;
  columns_ = cellOf(high.x(), low_.x()) + 1;
  rows_ = cellOf(high.y(), low_.y()) + 1;
  const auto bucket = [&](const SurfacePoint& point) {
    return static_cast<std::size_t>(cellOf(point.position.y(), low_.y()) * columns_ + cellOf(point.position.x(), low_.x()));
  };
  starts_.assign(static_cast<std::size_t>(columns_ * rows_) + 1, 0);
  for (const SurfacePoint& point : points) ++starts_[bucket(point) + 1];
  for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
  std::vector<std::size_t> next(starts_.begin(), starts_.end() - 1);
  points_.resize(points.size());
  for (const SurfacePoint& point : points) points_[next[bucket(point)]++] = point;
}

long PointIndex::cellOf(double value, double origin) const { return static_cast<long>(std::floor((value - origin) / cell_)); }

const SurfacePoint* PointIndex::nearest(const Eigen::Vector2d& position, const Eigen::Vector2d& normal, double reach) const {
  const SurfacePoint* best = nullptr;
  double least = reach * reach;
  const long column = cellOf(position.x(), low_.x()), row = cellOf(position.y(), low_.y());
  for (long r = std::max(row - 1, 0L); r <= std::min(row + 1, rows_ - 1); ++r) {
    const long first = std::max(column - 1, 0L), last = std::min(column + 1, columns_ - 1);
    if (first > last) continue;
    const std::size_t begin = starts_[static_cast<std::size_t>(r * columns_ + first)];
    const std::size_t end = starts_[static_cast<std::size_t>(r * columns_ + last) + 1];
    for (std::size_t i = begin; i < end; ++i) {
      const double distance = (points_[i].position - position).squaredNorm();
      if (distance < least && points_[i].normal.dot(normal) > kAlike) {
        least = distance;
        best = &points_[i];
      }
    }
  }
  return best;
}

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#include "distance_field.h"

#include <algorithm>
#include <cmath>

#include "parley_geometry/squared_distances.h"

namespace parley {

namespace {

constexpr double kReach = 2.0;  // [m]

struct Corner {
  int x, y;       // [cells] lower left of the four that surround a point
  double fx, fy;  // [-] in [0, 1]
};

Corner cornerAt(const GridFrame& frame, const Eigen::Vector2d& p) {
  const double u = std::clamp((p.x() - frame.origin.x()) / frame.resolution - 0.5, 0.0, frame.width - 1.001);
  const double v = std::clamp((p.y() - frame.origin.y()) / frame.resolution - 0.5, 0.0, frame.height - 1.001);
  const int x = static_cast<int>(u), y = static_cast<int>(v);
  return {x, y, u - x, v - y};
}

}  // namespace

DistanceField::DistanceField(const GridFrame& frame, const std::vector<unsigned char>& marked) : frame_(frame) {
  const int reach = std::clamp(static_cast<int>(std::ceil(kReach / frame.resolution)), 1, kMostReach);
  std::vector<float> metres(static_cast<std::size_t>(reach * reach + 1));
  for (std::size_t i = 0; i < metres.size(); ++i) {
    metres[i] = std::sqrt(static_cast<float>(i)) * static_cast<float>(frame.resolution);
  }
  const std::vector<std::int16_t> squares = squaredDistances(marked, frame.width, frame.height, reach);
  distances_.resize(squares.size());
  std::transform(squares.begin(), squares.end(), distances_.begin(),
                 [&](std::int16_t square) { return metres[static_cast<std::size_t>(square)]; });
}

double DistanceField::at(const Eigen::Vector2d& p) const {
  const Corner c = cornerAt(frame_, p);
  const float* row = &distances_[static_cast<std::size_t>(c.y * frame_.width + c.x)];
  const float* above = row + frame_.width;
  return (1.0 - c.fy) * ((1.0 - c.fx) * row[0] + c.fx * row[1]) + c.fy * ((1.0 - c.fx) * above[0] + c.fx * above[1]);
}

DistanceField::Sample DistanceField::sample(const Eigen::Vector2d& p) const {
  const Corner c = cornerAt(frame_, p);
  const float* row = &distances_[static_cast<std::size_t>(c.y * frame_.width + c.x)];
  const float* above = row + frame_.width;
  const double low = (1.0 - c.fx) * row[0] + c.fx * row[1];
  const double high = (1.0 - c.fx) * above[0] + c.fx * above[1];
  const double dx = (1.0 - c.fy) * (row[1] - row[0]) + c.fy * (above[1] - above[0]);
  return {(1.0 - c.fy) * low + c.fy * high, Eigen::Vector2d(dx, high - low) / frame_.resolution};
}

}  // namespace parley

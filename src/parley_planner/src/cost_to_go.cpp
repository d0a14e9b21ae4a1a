// SPDX-License-Identifier: BSD-3-Clause
#include "cost_to_go.h"

#include <array>
#include <cmath>
#include <limits>
#include <queue>

namespace parley {

namespace {

constexpr float kNone = std::numeric_limits<float>::infinity();
constexpr double kOctileExcess = 1.0824;  // [-] the most by which ways along eight directions are longer than straight ones
constexpr double kStepsInside = 2.5;      // [cells] the target and the asked point are at most so far off the cells' centres

}  // namespace

CostToGo::CostToGo(const Surroundings& surroundings, const Eigen::Vector2d& target, double clearance, double reach)
    : surroundings_(surroundings), clearance_(clearance), frame_(surroundings.frame()) {
  frame_.resolution *= 2.0;
  frame_.width = (frame_.width + 1) / 2;
  frame_.height = (frame_.height + 1) / 2;
  lengths_.assign(static_cast<std::size_t>(frame_.width) * static_cast<std::size_t>(frame_.height), kNone);
  const Eigen::Vector2i cell = frame_.cellOf(target);
  if (frame_.contains(cell)) flood(cell, reach * kOctileExcess);
}

bool CostToGo::isFree(int x, int y) const {
  const Eigen::Vector2d p = frame_.centerOf({x, y});
  return surroundings_.obstacles().at(p) >= clearance_ && surroundings_.unseen().at(p) > 0.0;
}

void CostToGo::flood(const Eigen::Vector2i& target, double reach) {
  using Entry = std::pair<float, int>;
  const std::array<Eigen::Vector2i, 8> steps{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}}};
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> open;
  lengths_[static_cast<std::size_t>(frame_.indexOf(target))] = 0.0F;
  open.emplace(0.0F, frame_.indexOf(target));
  while (!open.empty()) {
    const auto [length, cell] = open.top();
    open.pop();
    if (length > lengths_[static_cast<std::size_t>(cell)] || static_cast<double>(length) > reach) continue;
    for (const Eigen::Vector2i& step : steps) {
      const Eigen::Vector2i next(cell % frame_.width + step.x(), cell / frame_.width + step.y());
      if (!frame_.contains(next)) continue;
      const auto there = length + static_cast<float>(frame_.resolution * std::hypot(step.x(), step.y()));
      float& known = lengths_[static_cast<std::size_t>(frame_.indexOf(next))];
      if (there >= known || !isFree(next.x(), next.y())) continue;
      known = there;
      open.emplace(there, frame_.indexOf(next));
    }
  }
}

double CostToGo::at(const Eigen::Vector2d& p) const {
  const Eigen::Vector2i cell = frame_.cellOf(p);
  if (!frame_.contains(cell)) return static_cast<double>(kNone);
  const double length = static_cast<double>(lengths_[static_cast<std::size_t>(frame_.indexOf(cell))]);
  return std::max(0.0, length / kOctileExcess - kStepsInside * frame_.resolution);
}

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#include "grid_world.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <queue>
#include <stdexcept>
#include <utility>

namespace parley::study {
namespace {

constexpr float kMostClearance = 2.0F;  // [m]
constexpr double kInf = std::numeric_limits<double>::infinity();

/// Fills a rectangle given in metres.
void fill(std::vector<bool>& solid, int columns, double resolution, double x0, double y0, double x1, double y1, bool value) {
  const int rows = static_cast<int>(solid.size()) / columns;
  for (int row = std::max(0, static_cast<int>(std::lround(y0 / resolution)));
       row < std::min<double>(rows, y1 / resolution - 1e-6); ++row) {
    for (int column = std::max(0, static_cast<int>(std::lround(x0 / resolution)));
         column < std::min<double>(columns, x1 / resolution - 1e-6); ++column) {
      solid[static_cast<std::size_t>(row * columns + column)] = value;
    }
  }
}

}  // namespace

GridWorld::GridWorld(std::string name, double resolution, int columns, int rows, std::vector<bool> solid)
    : name_(std::move(name)), resolution_(resolution), columns_(columns), rows_(rows), solid_(std::move(solid)) {
  measureClearance();
}

GridWorld GridWorld::load(const std::string& path) {
  const YAML::Node node = YAML::LoadFile(path);
  const std::string folder = path.find('/') == std::string::npos ? "." : path.substr(0, path.rfind('/'));
  const cv::Mat image = cv::imread(folder + "/" + node["image"].as<std::string>(), cv::IMREAD_GRAYSCALE);
  if (image.empty()) throw std::runtime_error(path + ": no image");
  const double free_below = node["free_thresh"].as<double>();
  std::vector<bool> solid(static_cast<std::size_t>(image.rows) * static_cast<std::size_t>(image.cols));
  for (int row = 0; row < image.rows; ++row) {
    for (int column = 0; column < image.cols; ++column) {
      const double occupancy = (255 - image.at<std::uint8_t>(image.rows - 1 - row, column)) / 255.0;
      solid[static_cast<std::size_t>(row * image.cols + column)] = occupancy >= free_below;
    }
  }
  std::string name = path.substr(path.rfind('/') + 1);
  return GridWorld(name.substr(0, name.rfind('.')), node["resolution"].as<double>(), image.cols, image.rows, solid);
}

GridWorld GridWorld::periodic() {
  constexpr double kResolution = 0.05;
  constexpr int kSide = 960;  // [-] 48 m
  std::vector<bool> solid(static_cast<std::size_t>(kSide) * kSide, false);
  for (int i = 0; i < 12; ++i) {
    for (int j = 0; j < 12; ++j) {
      const double x = 4.0 * i, y = 4.0 * j;
      fill(solid, kSide, kResolution, x, y, x + 1.2, y + 0.2, true);
      fill(solid, kSide, kResolution, x, y, x + 0.2, y + 1.6, true);
      fill(solid, kSide, kResolution, x + 2.4, y + 2.2, x + 3.0, y + 2.6, true);
    }
  }
  return GridWorld("periodic", kResolution, kSide, kSide, solid);
}

GridWorld GridWorld::mirrored() {
  constexpr double kResolution = 0.05, kHeight = 20.0, kWidth = 40.0;
  constexpr int kColumns = 800, kRows = 400;
  std::vector<bool> solid(static_cast<std::size_t>(kColumns) * kRows, true);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const auto both = [&](double x0, double y0, double x1, double y1, bool value) {
    fill(solid, kColumns, kResolution, x0, y0, x1, y1, value);
    fill(solid, kColumns, kResolution, kWidth - x1, y0, kWidth - x0, y1, value);
  };
  both(0.2, 9.0, 20.0, 11.0, false);
  for (double x = 0.4; x < 19.0;) {
    const double width = 3.0 + 2.5 * unit(random), end = std::min(x + width, 19.8);
    both(x, 11.2, end - 0.2, 14.0 + 4.0 * unit(random), false);
    both(x, 8.8 - 3.0 - 3.0 * unit(random), end - 0.2, 8.8, false);
    const double up = x + (width - 1.6) * unit(random), down = x + (width - 1.6) * unit(random);
    both(up, 11.0, up + 1.3, 11.2, false);
    both(down, 8.8, down + 1.3, 9.0, false);
    both(x + 0.3, kHeight / 2 + 2.3, x + 0.9, kHeight / 2 + 2.7, true);
    x += width;
  }
  return GridWorld("mirrored", kResolution, kColumns, kRows, solid);
}

bool GridWorld::isSolid(long column, long row) const {
  return column < 0 || row < 0 || column >= columns_ || row >= rows_ || solid_[static_cast<std::size_t>(row * columns_ + column)];
}

double GridWorld::range(const Eigen::Vector2d& from, const Eigen::Vector2d& direction, double limit) const {
  long column = static_cast<long>(std::floor(from.x() / resolution_)),
       row = static_cast<long>(std::floor(from.y() / resolution_));
  const long step_x = direction.x() > 0.0 ? 1 : -1, step_y = direction.y() > 0.0 ? 1 : -1;
  const double per_x = direction.x() != 0.0 ? resolution_ / std::abs(direction.x()) : kInf;
  const double per_y = direction.y() != 0.0 ? resolution_ / std::abs(direction.y()) : kInf;
  const double edge_x = static_cast<double>(column + (step_x > 0 ? 1 : 0)) * resolution_;
  const double edge_y = static_cast<double>(row + (step_y > 0 ? 1 : 0)) * resolution_;
  double next_x = direction.x() != 0.0 ? (edge_x - from.x()) / direction.x() : kInf;
  double next_y = direction.y() != 0.0 ? (edge_y - from.y()) / direction.y() : kInf;
  double range = 0.0;
  while (range <= limit) {
    if (isSolid(column, row)) return range;
    if (next_x < next_y) {
      range = next_x;
      next_x += per_x;
      column += step_x;
    } else {
      range = next_y;
      next_y += per_y;
      row += step_y;
    }
  }
  return kInf;
}

/// Two passes of a chamfer transform: within 2 % of the true distance.
void GridWorld::measureClearance() {
  clearance_.assign(solid_.size(), kMostClearance);
  const float straight = static_cast<float>(resolution_), diagonal = straight * 1.4142F;
  const auto relax = [&](int column, int row, int side) {
    float& value = clearance_[static_cast<std::size_t>(row * columns_ + column)];
    if (isSolid(column, row)) {
      value = 0.0F;
      return;
    }
    const auto by = [&](int dx, int dy, float cost) {
      const int c = column + dx * side, r = row + dy * side;
      const bool outside = c < 0 || r < 0 || c >= columns_ || r >= rows_;
      value = std::min(value, (outside ? 0.0F : clearance_[static_cast<std::size_t>(r * columns_ + c)]) + cost);
    };
    by(-1, 0, straight);
    by(0, -1, straight);
    by(-1, -1, diagonal);
    by(1, -1, diagonal);
  };
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) relax(column, row, 1);
  }
  for (int row = rows_ - 1; row >= 0; --row) {
    for (int column = columns_ - 1; column >= 0; --column) relax(column, row, -1);
  }
}

double GridWorld::clearance(const Eigen::Vector2d& p) const {
  const long column = static_cast<long>(std::floor(p.x() / resolution_)),
             row = static_cast<long>(std::floor(p.y() / resolution_));
  if (isSolid(column, row)) return 0.0;
  return clearance_[static_cast<std::size_t>(row * columns_ + column)];
}

Eigen::Vector2d GridWorld::place(double clearance_wanted, std::mt19937& random) const {
  std::uniform_real_distribution<double> x(0.0, columns_ * resolution_), y(0.0, rows_ * resolution_);
  Eigen::Vector2d p;
  do {
    p.x() = x(random);
    p.y() = y(random);
  } while (clearance(p) < clearance_wanted);
  return p;
}

GoalField::GoalField(const GridWorld& world, const Eigen::Vector2d& goal, double clearance)
    : columns_(static_cast<long>(world.columns() * world.resolution() / kCell)),
      rows_(static_cast<long>(world.rows() * world.resolution() / kCell)),
      distances_(static_cast<std::size_t>(columns_ * rows_), std::numeric_limits<float>::infinity()) {
  constexpr float kMost = 30.0F;  // [m]
  using Entry = std::pair<float, long>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  distances_[static_cast<std::size_t>(cellOf(goal))] = 0.0F;
  open.emplace(0.0F, cellOf(goal));
  while (!open.empty()) {
    const auto [distance, cell] = open.top();
    open.pop();
    if (distance > distances_[static_cast<std::size_t>(cell)] || distance > kMost) continue;
    for (long dy = -1; dy <= 1; ++dy) {
      for (long dx = -1; dx <= 1; ++dx) {
        const long column = cell % columns_ + dx, row = cell / columns_ + dy;
        if (column < 0 || row < 0 || column >= columns_ || row >= rows_) continue;
        const long next = row * columns_ + column;
        const double room = world.clearance(centerOf(next));
        if (room < clearance) continue;
        const double step = kCell * std::hypot(static_cast<double>(dx), static_cast<double>(dy));
        const float through = distance + static_cast<float>(step * (1.0 + 1.0 * std::max(0.0, 0.6 - room)));
        if (through >= distances_[static_cast<std::size_t>(next)]) continue;
        distances_[static_cast<std::size_t>(next)] = through;
        open.emplace(through, next);
      }
    }
  }
}

long GoalField::cellOf(const Eigen::Vector2d& p) const {
  const long column = std::clamp(static_cast<long>(p.x() / kCell), 0L, columns_ - 1);
  return std::clamp(static_cast<long>(p.y() / kCell), 0L, rows_ - 1) * columns_ + column;
}

Eigen::Vector2d GoalField::centerOf(long cell) const {
  return {(static_cast<double>(cell % columns_) + 0.5) * kCell, (static_cast<double>(cell / columns_) + 0.5) * kCell};
}

double GoalField::distance(const Eigen::Vector2d& p) const { return distances_[static_cast<std::size_t>(cellOf(p))]; }

Eigen::Vector2d GoalField::target(const Eigen::Vector2d& p, double ahead) const {
  long cell = cellOf(p);
  for (int step = 0; step * kCell < ahead; ++step) {
    long best = cell;
    for (long dy = -1; dy <= 1; ++dy) {
      for (long dx = -1; dx <= 1; ++dx) {
        const long column = cell % columns_ + dx, row = cell / columns_ + dy;
        if (column < 0 || row < 0 || column >= columns_ || row >= rows_) continue;
        const long next = row * columns_ + column;
        if (distances_[static_cast<std::size_t>(next)] < distances_[static_cast<std::size_t>(best)]) best = next;
      }
    }
    if (best == cell) break;
    cell = best;
  }
  return centerOf(cell);
}

}  // namespace parley::study

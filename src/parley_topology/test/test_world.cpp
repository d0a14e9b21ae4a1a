// SPDX-License-Identifier: BSD-3-Clause
#include "test_world.h"

#include <cmath>
#include <limits>
#include <queue>

namespace parley {

TestWorld::TestWorld(double width, double height, double resolution)
    : resolution_(resolution),
      columns_(static_cast<int>(std::lround(width / resolution))),
      rows_(static_cast<int>(std::lround(height / resolution))),
      solid_(static_cast<std::size_t>(columns_ * rows_), 0) {}

TestWorld TestWorld::fromText(const std::vector<std::string>& rows, double cell) {
  TestWorld world(cell * static_cast<double>(rows.front().size()), cell * static_cast<double>(rows.size()));
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const double y = cell * static_cast<double>(rows.size() - 1 - r);
    for (std::size_t c = 0; c < rows[r].size(); ++c) {
      const double x = cell * static_cast<double>(c);
      if (rows[r][c] == '#') world.setBox(x, y, x + cell, y + cell);
    }
  }
  return world;
}

TestWorld TestWorld::rooms(double size, double room, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  TestWorld world(size, size);
  const double wall = 0.2;
  const int count = static_cast<int>(size / room);
  for (int i = 1; i < count; ++i) {
    world.setBox(i * room - wall / 2, 0, i * room + wall / 2, size);
    world.setBox(0, i * room - wall / 2, size, i * room + wall / 2);
  }
  for (int i = 1; i < count; ++i) {
    for (int j = 0; j < count; ++j) {  // doors in most walls, 1.0 to 1.8 m wide
      const double door = 1.0 + 0.8 * unit(random), at = (j + 0.15 + 0.4 * unit(random)) * room;
      if (unit(random) < 0.85) world.setBox(i * room - wall, at, i * room + wall, at + door, false);
      if (unit(random) < 0.85) world.setBox(at, i * room - wall, at + door, i * room + wall, false);
    }
  }
  for (int k = 0; k < count * count; ++k) {
    const double x = unit(random) * size, y = unit(random) * size, w = 0.3 + 0.7 * unit(random), h = 0.3 + 0.7 * unit(random);
    world.setBox(x, y, x + w, y + h);
  }
  return world;
}

TestWorld TestWorld::boxes(double size, int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  TestWorld world(size, size);
  for (int k = 0; k < count; ++k) {
    const double x = unit(random) * size, y = unit(random) * size, w = 0.3 + 2.0 * unit(random), h = 0.3 + 2.0 * unit(random);
    world.setBox(x, y, x + w, y + h);
  }
  return world;
}

void TestWorld::setBox(double x0, double y0, double x1, double y1, bool solid) {
  const auto cell = [this](double v) { return static_cast<int>(std::lround(v / resolution_)); };
  for (int y = std::max(0, cell(y0)); y < std::min(rows_, cell(y1)); ++y) {
    for (int x = std::max(0, cell(x0)); x < std::min(columns_, cell(x1)); ++x)
      solid_[static_cast<std::size_t>(y * columns_ + x)] = solid;
  }
}

bool TestWorld::isSolid(const Eigen::Vector2d& p) const {
  return solidCell(static_cast<int>(std::floor(p.x() / resolution_)), static_cast<int>(std::floor(p.y() / resolution_)));
}

bool TestWorld::isClear(const Eigen::Vector2d& p, double radius) const {
  const int spread = static_cast<int>(std::ceil(radius / resolution_)) + 1;
  const int cx = static_cast<int>(std::floor(p.x() / resolution_)), cy = static_cast<int>(std::floor(p.y() / resolution_));
  for (int y = cy - spread; y <= cy + spread; ++y) {
    for (int x = cx - spread; x <= cx + spread; ++x) {
      if (!solidCell(x, y)) continue;
      const Eigen::Vector2d low(x * resolution_, y * resolution_), high = low + Eigen::Vector2d(resolution_, resolution_);
      if ((p - p.cwiseMax(low).cwiseMin(high)).norm() < radius) return false;
    }
  }
  return true;
}

double TestWorld::cast(const Eigen::Vector2d& from, double angle, double range) const {
  const Eigen::Vector2d d(std::cos(angle), std::sin(angle));
  int cell[2] = {static_cast<int>(std::floor(from.x() / resolution_)), static_cast<int>(std::floor(from.y() / resolution_))};
  double next[2], step[2];
  for (int k = 0; k < 2; ++k) {
    step[k] = std::abs(d[k]) < 1e-12 ? std::numeric_limits<double>::infinity() : resolution_ / std::abs(d[k]);
    const double edge = (cell[k] + (d[k] > 0 ? 1 : 0)) * resolution_;
    next[k] = std::isinf(step[k]) ? step[k] : (edge - from[k]) / d[k];
  }
  double t = 0.0;
  while (t <= range && !solidCell(cell[0], cell[1])) {
    const int k = next[0] < next[1] ? 0 : 1;
    t = next[k];
    next[k] += step[k];
    cell[k] += d[k] > 0 ? 1 : -1;
  }
  return t <= range ? t : std::numeric_limits<double>::infinity();
}

ObstacleScan TestWorld::scan(const Pose2& pose, double range, int bins) const {
  ObstacleScan scan;
  scan.range_max = range;
  scan.ranges.resize(static_cast<std::size_t>(bins));
  for (std::size_t i = 0; i < scan.binCount(); ++i) {
    scan.ranges[i] = static_cast<float>(cast(pose.position(), pose.yaw + scan.bearingOf(i), range));
  }
  return scan;
}

ObstacleScan TestWorld::noisyScan(const Pose2& pose, double sigma, std::mt19937& random, double range, int bins) const {
  ObstacleScan result = scan(pose, range, bins);
  std::normal_distribution<float> noise(0.0F, static_cast<float>(sigma));
  for (float& r : result.ranges) {
    if (std::isfinite(r)) r = std::max(0.01F, r + noise(random));
  }
  return result;
}

double TestWorld::shortestWay(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double radius) const {
  std::vector<char> open(solid_.size());
  for (int y = 0; y < rows_; ++y) {
    for (int x = 0; x < columns_; ++x) {
      open[static_cast<std::size_t>(y * columns_ + x)] =
          isClear(Eigen::Vector2d((x + 0.5) * resolution_, (y + 0.5) * resolution_), radius);
    }
  }
  struct Move {
    int dx, dy;
    double length;
  };
  std::vector<Move> moves;
  for (int dx = -3; dx <= 3; ++dx) {
    for (int dy = -3; dy <= 3; ++dy) {
      const int a = std::abs(dx), b = std::abs(dy);
      const bool prime = (a == 1 && b == 0) || (a == 0 && b == 1) || (a == 1 && b == 1) || (a == 1 && b > 1) ||
                         (b == 1 && a > 1) || (a == 2 && b == 3) || (a == 3 && b == 2);
      if (prime) moves.push_back({dx, dy, std::hypot(dx, dy) * resolution_});
    }
  }
  const auto index = [this](const Eigen::Vector2d& p) {
    return static_cast<int>(p.y() / resolution_) * columns_ + static_cast<int>(p.x() / resolution_);
  };
  std::vector<double> cost(solid_.size(), std::numeric_limits<double>::infinity());
  std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<std::pair<double, int>>> queue;
  const auto at = [](int i) { return static_cast<std::size_t>(i); };
  cost[at(index(from))] = 0.0;
  queue.emplace(0.0, index(from));
  while (!queue.empty()) {
    const auto [so_far, i] = queue.top();
    queue.pop();
    if (so_far > cost[at(i)]) continue;
    if (i == index(to)) return so_far;
    const int x = i % columns_, y = i / columns_;
    for (const Move& move : moves) {
      const int nx = x + move.dx, ny = y + move.dy;
      if (nx < 0 || ny < 0 || nx >= columns_ || ny >= rows_ || !open[at(ny * columns_ + nx)]) continue;
      if (std::max(std::abs(move.dx), std::abs(move.dy)) > 1) {  // the cells between
        const int mx = x + static_cast<int>(std::lround(0.5 * move.dx)), my = y + static_cast<int>(std::lround(0.5 * move.dy));
        if (!open[at(my * columns_ + mx)]) continue;
      }
      const double there = so_far + move.length;
      if (there >= cost[at(ny * columns_ + nx)]) continue;
      cost[at(ny * columns_ + nx)] = there;
      queue.emplace(there, ny * columns_ + nx);
    }
  }
  return std::numeric_limits<double>::infinity();
}

std::vector<LayerContour> TestWorld::outlines() const {
  std::vector<LayerContour> contours;
  const auto add = [&](double x0, double y0, double x1, double y1) {
    contours.push_back({{Eigen::Vector2d(x0, y0) * resolution_, Eigen::Vector2d(x1, y1) * resolution_}, false});
  };
  for (int y = 0; y <= rows_; ++y) {  // borders between solid and free, as runs of horizontal and of vertical lines
    for (int x = 0, start = -1; x <= columns_; ++x) {
      const bool border = x < columns_ && solidCell(x, y - 1) != solidCell(x, y);
      if (border && start < 0) start = x;
      if (!border && start >= 0) add(start, y, x, y), start = -1;
    }
  }
  for (int x = 0; x <= columns_; ++x) {
    for (int y = 0, start = -1; y <= rows_; ++y) {
      const bool border = y < rows_ && solidCell(x - 1, y) != solidCell(x, y);
      if (border && start < 0) start = y;
      if (!border && start >= 0) add(x, start, x, y), start = -1;
    }
  }
  return contours;
}

Footprint testFootprint() { return {0.8, 0.4}; }

namespace {

/// What is left of a way after a step along it.
std::vector<Eigen::Vector2d> stepAlong(std::vector<Eigen::Vector2d> way, double step) {
  while (way.size() > 1) {
    const double length = (way[1] - way[0]).norm();
    if (length > step) {
      way[0] += (way[1] - way[0]) * (step / length);
      return way;
    }
    step -= length;
    way.erase(way.begin());
  }
  return way;
}

}  // namespace

Drive drive(Topology& topology, const TestWorld& world, Eigen::Vector2d position, const Eigen::Vector2d& goal,
            const DriveOptions& options) {
  std::mt19937 random(options.seed);
  Drive result;
  double yaw = 0.0;
  for (int i = 0; i < options.max_scans; ++i) {
    const Pose2 pose{position.x(), position.y(), yaw};
    if (options.each) options.each(i, topology);
    topology.integrate(world.noisyScan(pose, options.noise, random), pose);
    if (i % 2 == 0 || !result.last.exists()) {
      const TopologyResult update = topology.update();
      result.last = topology.route(pose, goal);
      if (options.after) options.after(i, update, result.last);
    }
    result.switches = result.last.switches;
    if (!result.last.exists()) return result;
    result.last.points = stepAlong(result.last.points, options.step);
    const Eigen::Vector2d next = result.last.points.front();
    yaw = std::atan2(next.y() - position.y(), next.x() - position.x());
    result.length += (next - position).norm();
    result.hit = result.hit || world.isSolid(next);
    position = next;
    if ((position - goal).norm() < 0.3) {
      result.arrived = true;
      return result;
    }
  }
  return result;
}

}  // namespace parley

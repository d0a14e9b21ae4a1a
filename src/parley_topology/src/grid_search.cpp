// SPDX-License-Identifier: BSD-3-Clause
#include "grid_search.h"

#include <array>

#include "parley_geometry/polygon.h"

namespace parley {
namespace {

constexpr int kMargin = 8;  // [cells] of open space around all that is known, to go around it

/// Where a way may be: anywhere if there are no points.
struct Tube {
  const std::vector<Eigen::Vector2d>& points;
  double radius;  // [m]

  bool holds(const Eigen::Vector2d& p) const {
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      if (pointSegmentDistance(p, points[i], points[i + 1]) <= radius) return true;
    }
    return points.empty();
  }
};

/// Two floods over the cells of a rectangle that holds all tiles, start and goal. Cells are numbered by rows.
class TwoFloods {
 public:
  TwoFloods(const TiledMap& map, const Eigen::Vector2i& start, const Eigen::Vector2i& goal, const Tube& tube)
      : map_(map), tube_(tube) {
    rect_ = CellRect{start.x(), start.y(), start.x() + 1, start.y() + 1}.united({goal.x(), goal.y(), goal.x() + 1, goal.y() + 1});
    for (const auto& tile : map.tiles()) rect_ = rect_.united(tile->rect());
    rect_ = rect_.grown(kMargin);
    parent_.assign(static_cast<std::size_t>(rect_.width()) * static_cast<std::size_t>(rect_.height()), kNew);
    begin(floods_[0], start, kRootOfStart);
    begin(floods_[1], goal, kRootOfGoal);
  }

  /// Cells from start to goal; empty if one of the floods has filled its place, or both together `max_cells`.
  std::vector<Eigen::Vector2i> search(int max_cells) {
    for (int turn = 0; static_cast<int>(floods_[0].size() + floods_[1].size()) <= max_cells; turn = 1 - turn) {
      std::vector<int>& flood = floods_[static_cast<std::size_t>(turn)];
      std::size_t& next = next_[static_cast<std::size_t>(turn)];
      const std::size_t ring_end = flood.size();
      if (next == ring_end) return {};
      for (; next < ring_end; ++next) {
        if (spread(flood, flood[next], turn)) return joined();
      }
    }
    return {};
  }

 private:
  static constexpr int kNew = -1, kRootOfStart = -2, kRootOfGoal = -3;

  int& parentOf(int cell) { return parent_[static_cast<std::size_t>(cell)]; }
  Eigen::Vector2i placeOf(int cell) const { return {rect_.x0 + cell % rect_.width(), rect_.y0 + cell / rect_.width()}; }
  void begin(std::vector<int>& flood, const Eigen::Vector2i& place, int root) {
    const int cell = (place.y() - rect_.y0) * rect_.width() + place.x() - rect_.x0;
    if (parentOf(cell) != kNew) {  // start and goal in one cell
      meeting_ = {cell, cell};
      return;
    }
    parentOf(cell) = root;
    flood.push_back(cell);
    owner_.resize(parent_.size(), 0);
    owner_[static_cast<std::size_t>(cell)] = root == kRootOfStart ? 1 : 2;
  }

  /// Takes the free neighbours of a cell; true if one of them belongs to the other flood.
  bool spread(std::vector<int>& flood, int cell, int turn) {
    if (meeting_[0] >= 0) return true;
    const Eigen::Vector2i place = placeOf(cell);
    const std::array<Eigen::Vector2i, 4> steps{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
    const char own = turn == 0 ? 1 : 2;
    for (const Eigen::Vector2i& step : steps) {
      const Eigen::Vector2i p = place + step;
      if (p.x() < rect_.x0 || p.y() < rect_.y0 || p.x() >= rect_.x1 || p.y() >= rect_.y1) continue;
      if (!(map_.flags(p.x(), p.y()) & kPassable)) continue;
      const int next = cell + step.x() + step.y() * rect_.width();
      char& owner = owner_[static_cast<std::size_t>(next)];
      if (owner == own || !tube_.holds(map_.centerOf(p.x(), p.y()))) continue;
      if (owner != 0) {
        meeting_ = turn == 0 ? std::array<int, 2>{cell, next} : std::array<int, 2>{next, cell};
        return true;
      }
      owner = own;
      parentOf(next) = cell;
      flood.push_back(next);
    }
    return false;
  }

  std::vector<Eigen::Vector2i> joined() {
    std::vector<Eigen::Vector2i> way;
    for (int cell = meeting_[0]; cell >= 0; cell = parentOf(cell)) way.push_back(placeOf(cell));
    std::reverse(way.begin(), way.end());
    if (meeting_[0] == meeting_[1]) return way;
    for (int cell = meeting_[1]; cell >= 0; cell = parentOf(cell)) way.push_back(placeOf(cell));
    return way;
  }

  const TiledMap& map_;
  const Tube tube_;
  CellRect rect_;
  std::vector<int> parent_;
  std::vector<char> owner_;
  std::array<std::vector<int>, 2> floods_;
  std::array<std::size_t, 2> next_{{0, 0}};
  std::array<int, 2> meeting_{{-1, -1}};
};

}  // namespace

std::vector<Eigen::Vector2d> searchGrid(const TiledMap& map, const Sight& sight, const Eigen::Vector2d& start,
                                        const Eigen::Vector2d& goal, int max_cells, const std::vector<Eigen::Vector2d>& tube,
                                        double radius) {
  const auto cellOf = [&map](const Eigen::Vector2d& p) { return Eigen::Vector2i(map.cellOf(p.x()), map.cellOf(p.y())); };
  const std::vector<Eigen::Vector2i> cells = TwoFloods(map, cellOf(start), cellOf(goal), {tube, radius}).search(max_cells);
  if (cells.empty()) return {};
  std::vector<Eigen::Vector2d> way{start};
  std::size_t from = 0;
  while (from + 1 < cells.size()) {  // as far along as can be seen, doubling the stride
    std::size_t to = from + 1;
    for (std::size_t stride = 2; from + stride < cells.size(); stride *= 2) {
      const Eigen::Vector2i& cell = cells[from + stride];
      if (!sight.walk(way.back(), map.centerOf(cell.x(), cell.y())).open) break;
      to = from + stride;
    }
    for (std::size_t next = to + 1; next < cells.size(); ++next) {
      const Eigen::Vector2i& cell = cells[next];
      if (!sight.walk(way.back(), map.centerOf(cell.x(), cell.y())).open) break;
      to = next;
    }
    way.push_back(map.centerOf(cells[to].x(), cells[to].y()));
    from = to;
  }
  way.back() = goal;
  if (way.size() < 2) way.push_back(goal);
  return way;
}

}  // namespace parley

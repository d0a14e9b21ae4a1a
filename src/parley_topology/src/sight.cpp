// SPDX-License-Identifier: BSD-3-Clause
#include "sight.h"

#include <array>
#include <utility>
#include <vector>

namespace parley {
namespace {

constexpr double kStep = 1.5;           // [cells] between samples along a way: what blocks is several cells thick
constexpr double kFieldSlack = 0.1;     // [m] a cell's distance holds for all of it, and is rounded
constexpr double kFieldStretch = 1.05;  // [-] the field's distances fall by up to this for a metre of way
constexpr double kWidthStep = 0.25;     // [m] between samples of the passage width
constexpr double kPostRadius = 0.12;    // [m] rays across a passage end this close to an obstacle, so that they miss no post

/// The same way with its ends in a fixed order.
std::pair<Eigen::Vector2d, Eigen::Vector2d> ordered(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const bool keep = a.x() < b.x() || (a.x() == b.x() && a.y() <= b.y());
  return keep ? std::make_pair(a, b) : std::make_pair(b, a);
}

}  // namespace

double costOf(const Edge& edge, const TopologyOptions& options) {
  return edge.length + (options.unknown_cost - 1.0) * edge.unknown_length + options.narrow_cost * edge.narrow_length +
         options.tentative_cost * edge.tentative_length;
}

void measureEdge(VisibilityGraph& graph, int slot, const Sight& sight) {
  Edge& edge = graph.edge(slot);
  if (edge.measured || edge.from < 0) return;
  const Edge measures = sight.measure(graph.vertex(edge.from).position, graph.vertex(edge.to).position);
  edge.clearance = measures.clearance;
  edge.unknown_length = measures.unknown_length;
  edge.narrow_length = measures.narrow_length;
  edge.tentative_length = measures.tentative_length;
  edge.cost = measures.cost;
  edge.measured = true;
}

/// The samples of a straight way, in cells, from the end that comes first.
struct Sight::Samples {
  Samples(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double resolution) {
    const auto [p, q] = ordered(a, b);
    turned = p != a;
    start = p / resolution;
    const Eigen::Vector2d way = (q - p) / resolution;
    count = std::max(1, static_cast<int>(std::ceil(way.norm() / kStep)));
    step = way / count;
  }
  Eigen::Vector2i at(int i) const {
    return {static_cast<int>(std::floor(start.x() + i * step.x())), static_cast<int>(std::floor(start.y() + i * step.y()))};
  }
  Eigen::Vector2d start, step;
  int count = 0;  // after the first
  bool turned = false;
};

Walk Sight::walk(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double from, double to) const {
  const Samples way(a, b, map_.resolution());
  if (way.turned) from = 1.0 - std::exchange(to, 1.0 - from);
  const double stride = std::max(1e-9, way.step.norm()) * map_.resolution();
  const double samples_per_room = 1.0 / (kFieldStretch * stride), tight = shape_.grown_radius + kFieldSlack;
  const int first = std::max(0, static_cast<int>(from * way.count) - 1);
  const int last = std::min(way.count, static_cast<int>(to * way.count) + 2);
  for (int i = first; i <= last; ++i) {
    const Eigen::Vector2i at = way.at(i);
    const Tile* tile = map_.find(tileOf(at.x()), tileOf(at.y()));
    const std::size_t cell = offsetOf(at.x(), at.y());
    const double room = metersOf(tile ? tile->distance[cell] : kFarAway, shape_.reach) - tight;
    if (room > 0.0) {
      i += static_cast<int>(std::min<double>(way.count, room * samples_per_room));  // all samples up to there are wide
    } else if (tile && !(tile->flags[cell] & kPassable)) {
      return {false, at};
    }
  }
  return {true, {}};
}

std::optional<Eigen::Vector2i> Sight::shutNear(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                                               const Eigen::Vector2i& cell) const {
  const Samples way(a, b, map_.resolution());
  const Eigen::Vector2d to = cell.cast<double>().array() + 0.5 - way.start.array();
  const double nearest = to.dot(way.step) / std::max(1e-9, way.step.squaredNorm());
  const int middle = static_cast<int>(std::clamp(nearest, 0.0, static_cast<double>(way.count)));
  for (int i = middle; i <= std::min(middle + 1, way.count); ++i) {
    const Eigen::Vector2i at = way.at(i);
    if (!(map_.flags(at.x(), at.y()) & kPassable)) return at;
  }
  return std::nullopt;
}

Edge Sight::measure(const Eigen::Vector2d& a, const Eigen::Vector2d& b) const {
  const auto [p, q] = ordered(a, b);
  Edge edge;
  edge.length = (q - p).norm();
  measureWidth(edge, p, q);
  measureSeen(edge, p, q);
  edge.cost = costOf(edge, options_);
  edge.measured = true;
  return edge;
}

void Sight::measureSeen(Edge& edge, const Eigen::Vector2d& a, const Eigen::Vector2d& b) const {
  const int steps = std::max(1, static_cast<int>(std::ceil(edge.length / (2.0 * map_.resolution()))));
  int unknown = 0, tentative = 0;
  for (int i = 0; i < steps; ++i) {
    const std::uint8_t flags = flagsAt(a + (b - a) * ((i + 0.5) / steps));
    unknown += flags & kSeen ? 0 : 1;
    tentative += flags & kTentative ? 1 : 0;
  }
  edge.unknown_length = edge.length * unknown / steps;
  edge.tentative_length = edge.length * tentative / steps;
}

std::optional<Edge> Sight::look(const Eigen::Vector2d& a, const Eigen::Vector2d& b) const {
  if (!walk(a, b).open) return std::nullopt;
  return measure(a, b);
}

double Sight::roomTowards(const Eigen::Vector2d& from, const Eigen::Vector2d& direction, double enough) const {
  double along = 0.0;
  while (along < enough) {
    const double distance = distanceAt(from + along * direction);
    if (distance <= kPostRadius) return std::min(enough, along + distance);
    along += distance;
  }
  return enough;
}

/// Room to the left plus room to the right, each the least of three neighbouring samples: the posts of a doorway that is
/// crossed at a slant are not at the same place along the way.
void Sight::measureWidth(Edge& edge, const Eigen::Vector2d& a, const Eigen::Vector2d& b) const {
  const double cap = options_.clearance_cap;
  edge.clearance = cap;
  edge.narrow_length = 0.0;
  if (!(edge.length > 0.0)) return;
  const Eigen::Vector2d along = (b - a) / edge.length, left(-along.y(), along.x());
  const int steps = std::max(1, static_cast<int>(std::ceil(edge.length / kWidthStep)));
  std::array<double, 3> left_room{cap, cap, cap}, right_room{cap, cap, cap};
  for (int i = 0; i <= steps + 1; ++i) {
    const Eigen::Vector2d p = a + (b - a) * (static_cast<double>(i) / steps);
    const bool narrow = i <= steps && distanceAt(p) < 0.5 * cap;
    left_room = {left_room[1], left_room[2], narrow ? roomTowards(p, left, cap) : cap};
    right_room = {right_room[1], right_room[2], narrow ? roomTowards(p, -left, cap) : cap};
    if (i == 0) continue;
    const double width =
        *std::min_element(left_room.begin(), left_room.end()) + *std::min_element(right_room.begin(), right_room.end());
    edge.clearance = std::min(edge.clearance, width);
    if (width < options_.narrow_width) edge.narrow_length += (1.0 - width / options_.narrow_width) * edge.length / (steps + 1);
  }
}

bool Sight::reaches(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const {
  const int steps = static_cast<int>(std::ceil((to - from).norm() / (0.5 * map_.resolution())));
  for (int i = 1; i <= steps; ++i) {
    if (flagsAt(from + (to - from) * (static_cast<double>(i) / steps)) & kFused) return false;
  }
  return true;
}

std::optional<Eigen::Vector2d> Sight::nearestWith(CellFlag flag, const Eigen::Vector2d& p, double tolerance) const {
  if (flagsAt(p) & flag) return p;
  const int cx = map_.cellOf(p.x()), cy = map_.cellOf(p.y());
  const int spread = static_cast<int>(std::ceil(tolerance / map_.resolution()));
  const bool from_inside = flagsAt(p) & kFused;
  std::optional<Eigen::Vector2d> nearest;
  double least = tolerance;
  for (int y = cy - spread; y <= cy + spread; ++y) {
    for (int x = cx - spread; x <= cx + spread; ++x) {
      if (!(map_.flags(x, y) & flag)) continue;
      const Eigen::Vector2d candidate = map_.centerOf(x, y);
      const double distance = (candidate - p).norm();
      if (distance >= least || (!from_inside && !reaches(p, candidate))) continue;
      nearest = candidate;
      least = distance;
    }
  }
  return nearest;
}

}  // namespace parley

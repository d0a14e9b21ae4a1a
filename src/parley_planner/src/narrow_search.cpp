// SPDX-License-Identifier: BSD-3-Clause
#include "narrow_search.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <unordered_map>

#include "cost_to_go.h"
#include "parley_geometry/polygon.h"

namespace parley {

namespace {

constexpr double kCell = 0.05;                   // [m]
constexpr int kHeadings = 48;                    // [-] in a full turn
constexpr double kTurn = 2.0 * kPi / kHeadings;  // [rad] of one move
constexpr double kStride = 0.1;                  // [m] of one move
// Beside a wall only a gentle bend leads off it: turned faster, a corner would meet the wall.
constexpr double kBend = 0.5 * kTurn;  // [rad] of one move
constexpr double kBendStride = 0.5;    // [m]
constexpr double kBesideWall = 0.012;  // [m] that it may come nearer
constexpr double kReversePrice = 1.3;  // [-] it is blind to nothing, but others expect it less
constexpr double kSwitchPrice = 0.6;   // [s] another kind of move: stop and start again
constexpr double kTypicalSpeed = 0.4;  // [m/s]
constexpr double kReach = 8.0;         // [m] longer ways are not looked for
constexpr double kFarBody = 0.3;       // [m] further off is all the same
constexpr double kFieldError = 0.04;   // [m] by which cells may make a place look narrower than it is

/// One move: a turn on the spot, or a stretch on a curvature.
struct Move {
  double turn = 0.0;    // [rad]
  double length = 0.0;  // [m] negative backwards
  bool operator==(const Move& other) const { return turn == other.turn && length == other.length; }
};

std::vector<Move> allMoves() {
  return {{0.0, kStride},       {kTurn, kStride},      {-kTurn, kStride},     {0.0, -kStride},
          {kTurn, -kStride},    {-kTurn, -kStride},    {kTurn, 0.0},          {-kTurn, 0.0},
          {kBend, kBendStride}, {-kBend, kBendStride}, {kBend, -kBendStride}, {-kBend, -kBendStride}};
}

Pose2 moved(const Pose2& pose, const Move& move, double share) { return integrateTwist(pose, move.length, move.turn, share); }

struct Node {
  Pose2 pose;
  int parent = -1;
  int move = -1;
  double cost = 0.0;  // [s]
  bool closed = false;
};

struct Entry {
  double estimate;
  int node;
  bool operator>(const Entry& other) const { return estimate != other.estimate ? estimate > other.estimate : node > other.node; }
};

class Search {
 public:
  Search(const Pose2& start, const Eigen::Vector2d& target, const Surroundings& surroundings, const FootprintProbe& probe,
         const NarrowSearchOptions& options)
      : target_(target),
        surroundings_(surroundings),
        probe_(probe),
        options_(options),
        moves_(allMoves()),
        guide_(options.with_them != nullptr ? *options.with_them : surroundings, target, probe.inscribedRadius() - kFieldError,
               kReach) {
    floor_ = std::min(options.clearance, probe.clearance(surroundings.obstacles(), start) - kBesideWall);
    unseen_floor_ = std::min(0.0, probe.clearance(surroundings.unseen(), start) - 1e-3);
    body_floor_ = std::min(0.0, bodyClearance(start) - 1e-3);
    nodes_.push_back({start, -1, -1, 0.0, false});
    index_[key(start)] = 0;
    open_.push({estimate(start), 0});
  }

  /// Moves to the target, first to last; empty if none were found.
  std::vector<Move> run() {
    for (int k = 0; k < options_.expansions && !open_.empty();) {
      const int current = open_.top().node;
      open_.pop();
      Node& node = nodes_[static_cast<std::size_t>(current)];
      if (node.closed) continue;
      node.closed = true;
      ++k;
      if ((node.pose.position() - target_).norm() < kTargetRadius) return movesTo(current);
      for (std::size_t m = 0; m < moves_.size(); ++m) expand(current, static_cast<int>(m));
    }
    return {};
  }

 private:
  static long key(const Pose2& pose) {
    const long x = std::lround(pose.x / kCell) + 100000, y = std::lround(pose.y / kCell) + 100000;
    const long heading = (std::lround(pose.yaw / kTurn) + kHeadings) % kHeadings;
    return (x * 200000 + y) * kHeadings + heading;
  }
  double estimate(const Pose2& pose) const { return guide_.at(pose.position()) / kTypicalSpeed; }

  bool isFree(const Pose2& pose) const {
    return probe_.clearance(surroundings_.obstacles(), pose) >= floor_ &&
           probe_.clearance(surroundings_.unseen(), pose) >= unseen_floor_ && bodyClearance(pose) >= body_floor_;
  }

  /// [m] more than should be kept from the nearest of those who stand.
  double bodyClearance(const Pose2& pose) const {
    double least = kFarBody;
    for (const Blocked::Body& body : options_.bodies) {
      const double reach = probe_.footprint().circumscribedRadius() + body.footprint.circumscribedRadius() + body.growth;
      if ((body.pose.position() - pose.position()).norm() > reach + kFarBody) continue;
      const Polygon there = body.footprint.polygonAt(body.pose);
      least = std::min(least, convexDistance(probe_.footprint().polygonAt(pose), there) - body.growth);
    }
    return least;
  }

  void expand(int from, int move_index) {
    const Node parent = nodes_[static_cast<std::size_t>(from)];
    const Move& move = moves_[static_cast<std::size_t>(move_index)];
    const Pose2 pose = moved(parent.pose, move, 1.0);
    double cost = parent.cost + std::abs(move.length) / kTypicalSpeed * (move.length < 0.0 ? kReversePrice : 1.0);
    if (move.length == 0.0) cost += std::abs(move.turn);
    if (parent.move != move_index) cost += kSwitchPrice;
    const auto found = index_.find(key(pose));
    if (found != index_.end()) {
      const Node& known = nodes_[static_cast<std::size_t>(found->second)];
      if (known.closed || known.cost <= cost) return;
    }
    const double ahead = estimate(pose);
    if (!std::isfinite(ahead) || !isFree(pose)) return;
    const int parts = static_cast<int>(std::ceil(std::max(2.0, std::abs(move.length) / kStride)));
    for (int i = 1; i < parts; ++i) {
      if (!isFree(moved(parent.pose, move, static_cast<double>(i) / parts))) return;
    }
    nodes_.push_back({pose, from, move_index, cost, false});
    const int index = static_cast<int>(nodes_.size()) - 1;
    if (found != index_.end()) nodes_[static_cast<std::size_t>(found->second)].closed = true;
    index_[key(pose)] = index;
    open_.push({cost + ahead, index});
  }

  std::vector<Move> movesTo(int node) const {
    std::vector<Move> result;
    for (; node > 0; node = nodes_[static_cast<std::size_t>(node)].parent) {
      result.push_back(moves_[static_cast<std::size_t>(nodes_[static_cast<std::size_t>(node)].move)]);
    }
    std::reverse(result.begin(), result.end());
    return result;
  }

  Eigen::Vector2d target_;
  const Surroundings& surroundings_;
  const FootprintProbe& probe_;
  const NarrowSearchOptions& options_;
  std::vector<Move> moves_;
  CostToGo guide_;
  double floor_, unseen_floor_, body_floor_;
  std::vector<Node> nodes_;
  std::unordered_map<long, int> index_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> open_;
};

/// From 0 to `total` in even steps, with the times at which the acceleration changes: between the states it is constant.
std::vector<double> evenTimes(double total, std::vector<double> times, double time_step) {
  const int steps = static_cast<int>(std::ceil(total / time_step));
  for (int k = 0; k <= steps; ++k) times.push_back(std::min(total, k * time_step));
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end(), [](double a, double b) { return b - a < 1e-4; }), times.end());
  return times;
}

}  // namespace

std::vector<TrajectoryPoint> driveArc(const TrajectoryPoint& start, double curvature, double length, double speed,
                                      const MotionLimits& limits, double time_step) {
  const double bend = std::abs(curvature), sign = length < 0.0 ? -1.0 : 1.0, way = std::abs(length);
  double acceleration = limits.acceleration, top = std::min(speed, limits.speed);
  if (bend > 1e-9) {
    acceleration = std::min(acceleration, limits.turn_acceleration / bend);
    top = std::min(top, limits.turn_rate / bend);
  }
  const double peak = std::min(top, std::sqrt(way * acceleration));
  const double ramp = peak / acceleration, hold = std::max(0.0, way / peak - ramp), total = 2.0 * ramp + hold;
  std::vector<TrajectoryPoint> points;
  for (const double t : evenTimes(total, {ramp, ramp + hold}, time_step)) {
    const double rising = std::min(t, ramp), level = std::clamp(t - ramp, 0.0, hold);
    const double falling = std::clamp(t - ramp - hold, 0.0, ramp);
    const double s = 0.5 * acceleration * (rising * rising - falling * falling) + peak * (level + falling);
    const double v = std::max(0.0, acceleration * (rising - falling));
    points.push_back({start.time + t, integrateTwist(start.pose, sign, sign * curvature, s), {sign * v, sign * v * curvature}});
  }
  points.back().twist = {};
  return points;
}

std::vector<TrajectoryPoint> searchNarrow(const TrajectoryPoint& start, const Eigen::Vector2d& target,
                                          const Surroundings& surroundings, const FootprintProbe& probe,
                                          const MotionLimits& limits, double time_step, const NarrowSearchOptions& options) {
  const std::vector<Move> moves = Search(start.pose, target, surroundings, probe, options).run();
  if (moves.empty()) return {};
  std::vector<TrajectoryPoint> points = {start};
  points.back().twist = {};
  for (std::size_t i = 0; i < moves.size();) {
    std::size_t same = i;
    while (same < moves.size() && moves[same] == moves[i]) ++same;
    const double count = static_cast<double>(same - i), length = count * moves[i].length;
    double left = count * moves[i].turn;
    std::vector<TrajectoryPoint> piece;
    if (length != 0.0) {
      piece = driveArc(points.back(), left / length, length, options.slow_speed, limits, time_step);
      points.insert(points.end(), piece.begin() + 1, piece.end());
    }
    while (length == 0.0 && std::abs(left) > 1e-9) {  // turns of pi and more have no shorter way
      const double turn = std::clamp(left, -0.75 * kPi, 0.75 * kPi);
      piece = turnOnSpot(points.back(), wrapAngle(points.back().pose.yaw + turn), limits, time_step);
      points.insert(points.end(), piece.begin() + 1, piece.end());
      left -= turn;
    }
    i = same;
  }
  return points;
}

}  // namespace parley

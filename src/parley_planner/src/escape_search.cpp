// SPDX-License-Identifier: BSD-3-Clause
#include "escape_search.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>

namespace parley {

namespace {

constexpr int kStride = 2;               // [cells] lattice spacing
constexpr double kReach = 25.0;          // [-] cost of the way to an escape point
constexpr double kRoom = 0.35;           // [m] with less than this round its middle a robot cannot turn,
constexpr double kRoomWeight = 4.0;      // [-] and a way through costs more
constexpr double kStandingGap = 0.15;    // [m] between a robot that stands aside and one that passes
constexpr double kTightStanding = 1.5;   // [m] of way a place is worth where the robot can stand with any heading
constexpr double kProgressWeight = 0.3;  // [-] of the way from there on
constexpr double kAgainstWeight = 3.0;   // [-] a metre towards whom one makes room for
constexpr double kBodyGap = 0.1;         // [m] round standing robots
constexpr double kPushWeight = 4.0;      // [-] a metre through a robot that will make room
constexpr double kFurtherOn = 0.3;       // [m]
constexpr double kStartRelief = 0.4;     // [m]
constexpr double kKeepBonus = 1.0;       // [m] of way that the last escape point is better than others
constexpr double kKeepReach = 0.3;       // [m]
constexpr double kFailedReach = 0.7;     // [m]
constexpr double kRetreat = 0.5;         // [m] less is not worth it
constexpr int kLastSteps = 5;            // [-] of the lattice, by which it comes there
constexpr double kAlong = 0.9;           // [-]
constexpr double kRim = 0.15;            // [m]
constexpr double kSidewaysFree = 0.15;   // [m]
constexpr double kSidewaysSlope = 0.3;   // [-]
constexpr float kInfinity = 1e30F;

class EscapeSearch {
 public:
  explicit EscapeSearch(const EscapeTask& task) : task_(task), frame_(task.surroundings.frame()) {
    frame_.width /= kStride;
    frame_.height /= kStride;
    frame_.resolution *= kStride;
    const auto size = static_cast<std::size_t>(frame_.width * frame_.height);
    costs_.assign(size, kInfinity);
    parents_.assign(size, -1);
    metres_.assign(size, std::numeric_limits<float>::quiet_NaN());
    for (const PeerTube& tube : task.first) starts_.push_back(placeIn(tube, task.start.position()).along);
    for (const PeerTube& other : task.others) {
      T_others_odom_.push_back(other.pose.inverse());
      makes_room_.push_back(goesBefore(task.right, other.right) || isPushedOn(other));
    }
    flood();
  }

  std::optional<Path> best() const {
    int target = -1;
    double least = 1e12;
    for (int node = 0; node < static_cast<int>(costs_.size()); ++node) {
      if (costs_[static_cast<std::size_t>(node)] >= kInfinity) continue;
      const std::optional<double> score = scoreOf(node);
      if (!score || *score >= least) continue;
      least = *score;
      target = node;
    }
    if (target < 0 && task_.room <= 0.0) target = furthestBack();
    return pathTo(target);
  }

  std::optional<Path> awayFrom(const Eigen::Vector2d& place) const {
    int target = -1;
    double furthest = (task_.start.position() - place).norm() + kRetreat;
    for (int node = 0; node < static_cast<int>(costs_.size()); ++node) {
      if (costs_[static_cast<std::size_t>(node)] >= kInfinity || (position(node) - place).norm() <= furthest) continue;
      furthest = (position(node) - place).norm();
      target = node;
    }
    return pathTo(target);
  }

 private:
  using Entry = std::pair<float, int>;

  std::optional<Path> pathTo(int target) const {
    if (target < 0) return std::nullopt;
    Path path;
    for (int node = target; node >= 0; node = parents_[static_cast<std::size_t>(node)]) path.push_back(position(node));
    std::reverse(path.begin(), path.end());
    path.front() = task_.start.position();
    if (path.size() < 2) path.push_back(position(target));
    return path;
  }

  /// With room for the robot before the window's rim, beyond which nothing is known.
  bool isInside(const Eigen::Vector2i& cell) const {
    const int rim = static_cast<int>(std::ceil((task_.footprint.circumscribedRadius() + kRim) / frame_.resolution));
    return cell.x() >= rim && cell.y() >= rim && cell.x() < frame_.width - rim && cell.y() < frame_.height - rim;
  }

  /// A robot cannot go sideways: where it fits one way round only, it has to be on its line some way before.
  bool isSideways(const Eigen::Vector2d& p) const {
    const Eigen::Vector2d q = task_.start.inverse() * p;
    return std::abs(q.y()) > kSidewaysFree + kSidewaysSlope * std::max(0.0, std::abs(q.x()) - kSidewaysFree);
  }

  Eigen::Vector2d position(int node) const { return frame_.centerOf({node % frame_.width, node / frame_.width}); }

  double roomAt(int node) const {
    const DistanceField& field = task_.surroundings.obstacles();
    const int x = node % frame_.width * kStride, y = node / frame_.width * kStride;
    return static_cast<double>(std::max(std::max(field.atCell(x, y), field.atCell(x + 1, y)),
                                        std::max(field.atCell(x, y + 1), field.atCell(x + 1, y + 1))));
  }

  /// Cost of a metre, negative where it is closed.
  double costAt(int node) const {
    const Eigen::Vector2d p = position(node);
    const bool at_start = (p - task_.start.position()).norm() < kStartRelief;
    const double room = roomAt(node), least = task_.footprint.inscribedRadius() + 0.01;
    if (room < (at_start ? 0.02 : least) || (!at_start && task_.surroundings.unseen().at(p) < least)) return -1.0;
    double cost = 1.0 + kRoomWeight * std::max(0.0, kRoom + 0.1 - room);
    for (std::size_t i = 0; i < task_.others.size(); ++i) {
      const PeerTube& other = task_.others[i];
      const Eigen::Vector2d q = T_others_odom_[i] * p;
      const double dx = std::max(0.0, std::abs(q.x()) - 0.5 * other.footprint.length);
      const double dy = std::max(0.0, std::abs(q.y()) - 0.5 * other.footprint.width);
      if (std::hypot(dx, dy) > least + kBodyGap) continue;
      if (makes_room_[i]) {
        cost += kPushWeight;
      } else if (!at_start) {
        return -1.0;
      }
    }
    for (std::size_t i = 0; i < task_.first.size(); ++i) {
      const TubePlace place = placeIn(task_.first[i], p);
      if (place.distance < clearOf(task_.first[i]) && place.along < starts_[i] - kFurtherOn) cost += kAgainstWeight;
    }
    return cost;
  }

  /// Makes room for the same robot as this one, and stands further along that one's way.
  bool isPushedOn(const PeerTube& other) const {
    if (other.right.depth == 0 || other.right.holder != task_.right.holder) return false;
    for (std::size_t i = 0; i < task_.first.size(); ++i) {
      const PeerTube& tube = task_.first[i];
      if (tube.id == other.id || tube.right.holder != task_.right.holder) continue;
      const TubePlace place = placeIn(tube, other.pose.position());
      if (place.distance < clearOf(tube) && place.along > starts_[i] + kFurtherOn) return true;
    }
    return false;
  }

  double clearOf(const PeerTube& tube) const {
    return 0.5 * tube.footprint.width + task_.footprint.inscribedRadius() + kStandingGap;
  }

  /// Whether the robot comes there on a line with the tube, so that it is no wider than it must be.
  bool isAlong(int node, const Eigen::Vector2d& direction) const {
    int from = node;
    for (int i = 0; i < kLastSteps && parents_[static_cast<std::size_t>(from)] >= 0; ++i)
      from = parents_[static_cast<std::size_t>(from)];
    const Eigen::Vector2d step = position(node) - position(from);
    if (step.norm() < 1e-6) return std::abs(task_.start.direction().dot(direction)) > kAlong;
    return std::abs(step.normalized().dot(direction)) > kAlong;
  }

  /// Where the peer's way ends it stands, with any heading.
  double endOf(const PeerTube& tube) const {
    return task_.footprint.circumscribedRadius() + tube.footprint.circumscribedRadius() + kStandingGap;
  }

  /// nullopt where it must not stand.
  std::optional<double> scoreOf(int node) const {
    if (task_.room > 0.0 && roomAt(node) < task_.room) return std::nullopt;
    const Eigen::Vector2d p = position(node);
    const double turning = task_.footprint.circumscribedRadius() - task_.footprint.inscribedRadius();
    double score = static_cast<double>(costs_[static_cast<std::size_t>(node)]) + kProgressWeight * (p - task_.goal).norm();
    bool tight = roomAt(node) < task_.footprint.circumscribedRadius() + 0.03;
    for (const PeerTube& tube : task_.first) {
      const TubePlace place = placeIn(tube, p);
      const double distance = place.distance;
      if (distance < clearOf(tube) + turning && !isAlong(node, place.direction)) return std::nullopt;
      if (distance < clearOf(tube) || (tube.way.back() - p).norm() < endOf(tube)) return std::nullopt;
      if (tube.stuck && (tube.pose.position() - p).norm() < endOf(tube)) return std::nullopt;
      tight = tight || distance < clearOf(tube) + turning;
    }
    for (const PeerTube& other : task_.others) {
      if ((other.pose.position() - p).norm() < task_.footprint.circumscribedRadius() + other.footprint.circumscribedRadius() &&
          goesBefore(other.right, task_.right)) {
        return std::nullopt;
      }
    }
    for (const Eigen::Vector2d& failed : task_.failed) {
      if ((failed - p).norm() < kFailedReach) return std::nullopt;
    }
    if (tight && isSideways(p)) return std::nullopt;
    if (tight) score += kTightStanding;
    if (task_.last && (*task_.last - p).norm() < kKeepReach) score -= kKeepBonus;
    return score;
  }

  /// Where no place is out of the way: as far along the tubes as can be reached, if that is further than here.
  int furthestBack() const {
    int target = -1;
    double best = kRetreat;
    for (int node = 0; node < static_cast<int>(costs_.size()); ++node) {
      if (costs_[static_cast<std::size_t>(node)] >= kInfinity) continue;
      double ahead = 1e3;
      for (std::size_t i = 0; i < task_.first.size(); ++i) {
        ahead = std::min(ahead, placeIn(task_.first[i], position(node)).along - starts_[i]);
      }
      const double value = ahead - 0.1 * static_cast<double>(costs_[static_cast<std::size_t>(node)]);
      if (value <= best) continue;
      best = value;
      target = node;
    }
    return target;
  }

  void flood() {
    const Eigen::Vector2i cell = frame_.cellOf(task_.start.position());
    if (!frame_.contains(cell)) return;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> open;
    costs_[static_cast<std::size_t>(frame_.indexOf(cell))] = 0.0F;
    open.emplace(0.0F, frame_.indexOf(cell));
    while (!open.empty()) {
      const auto [cost, node] = open.top();
      open.pop();
      if (cost > costs_[static_cast<std::size_t>(node)] || static_cast<double>(cost) > kReach) continue;
      for (int step = 0; step < 9; ++step) {
        const int dx = step % 3 - 1, dy = step / 3 - 1;
        const Eigen::Vector2i next(node % frame_.width + dx, node / frame_.width + dy);
        if ((dx == 0 && dy == 0) || !isInside(next)) continue;
        const int to = frame_.indexOf(next);
        const auto length = static_cast<float>(frame_.resolution * std::hypot(dx, dy));
        if (cost + length >= costs_[static_cast<std::size_t>(to)]) continue;
        float& metre = metres_[static_cast<std::size_t>(to)];
        if (std::isnan(metre)) metre = static_cast<float>(costAt(to));
        if (metre < 0.0F) continue;
        const float there = cost + metre * length;
        if (there >= costs_[static_cast<std::size_t>(to)]) continue;
        costs_[static_cast<std::size_t>(to)] = there;
        parents_[static_cast<std::size_t>(to)] = node;
        open.emplace(there, to);
      }
    }
  }

  const EscapeTask& task_;
  GridFrame frame_;
  std::vector<double> starts_;  // [m] how far along each tube the robot is
  std::vector<Pose2> T_others_odom_;
  std::vector<bool> makes_room_;  // who stands in the way and will not for long
  std::vector<float> costs_;      // [-] of the way from the start
  std::vector<float> metres_;     // [-] cost of a metre, NaN where nobody asked yet
  std::vector<int> parents_;
};

}  // namespace

std::optional<Path> escapePath(const EscapeTask& task) { return EscapeSearch(task).best(); }

std::optional<Path> pathAwayFrom(const EscapeTask& task, const Eigen::Vector2d& place) {
  return EscapeSearch(task).awayFrom(place);
}

}  // namespace parley

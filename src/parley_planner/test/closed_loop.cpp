// SPDX-License-Identifier: BSD-3-Clause
#include "closed_loop.h"

#include <algorithm>
#include <cmath>
#include <ctime>

#include "parley_geometry/polygon.h"
#include "path_search.h"

namespace parley {

namespace {

constexpr double kCell = 0.05, kRange = 4.0, kWindow = 10.0;
constexpr int kBeams = 720;

}  // namespace

World::World(double width, double height, bool filled) {
  frame.resolution = kCell;
  frame.width = static_cast<int>(std::lround(width / kCell));
  frame.height = static_cast<int>(std::lround(height / kCell));
  solid.assign(static_cast<std::size_t>(frame.width * frame.height), filled);
}

bool World::solidAt(const Eigen::Vector2d& p) const {
  const Eigen::Vector2i cell = frame.cellOf(p);
  return !frame.contains(cell) || solid[static_cast<std::size_t>(frame.indexOf(cell))];
}

void World::fill(double x1, double y1, double x2, double y2, bool value) {
  for (int y = static_cast<int>(std::lround(y1 / kCell)); y < std::lround(y2 / kCell); ++y) {
    for (int x = static_cast<int>(std::lround(x1 / kCell)); x < std::lround(x2 / kCell); ++x) {
      if (frame.contains({x, y})) solid[static_cast<std::size_t>(frame.indexOf({x, y}))] = value;
    }
  }
}

double World::castRay(const Eigen::Vector2d& from, double bearing, double range_max) const {
  const Eigen::Vector2d direction(std::cos(bearing), std::sin(bearing));
  Eigen::Vector2i cell = frame.cellOf(from);
  double range = 0.0;
  while (range <= range_max) {
    if (!frame.contains(cell) || solid[static_cast<std::size_t>(frame.indexOf(cell))]) return range;
    double next = 1e9;
    int axis = 0;
    for (int a = 0; a < 2; ++a) {
      if (std::abs(direction[a]) < 1e-12) continue;
      const double edge = frame.origin[a] + (cell[a] + (direction[a] > 0.0 ? 1 : 0)) * kCell;
      const double t = (edge - from[a]) / direction[a];
      if (t < next) {
        next = t;
        axis = a;
      }
    }
    range = next;
    cell[axis] += direction[axis] > 0.0 ? 1 : -1;
  }
  return std::numeric_limits<double>::infinity();
}

double World::clearance(const Footprint& footprint, const Pose2& pose) const {
  const Polygon body = footprint.polygonAt(pose);
  const double reach = footprint.circumscribedRadius() + 0.5;
  const Eigen::Vector2i low = frame.cellOf(pose.position() - Eigen::Vector2d::Constant(reach));
  const Eigen::Vector2i high = frame.cellOf(pose.position() + Eigen::Vector2d::Constant(reach));
  double least = 0.5;
  for (int y = low.y(); y <= high.y(); ++y) {
    for (int x = low.x(); x <= high.x(); ++x) {
      const Eigen::Vector2d middle = frame.centerOf({x, y});
      if (!solidAt(middle)) continue;
      const Eigen::Vector2d p = pose.inverse() * middle;
      const double dx = std::max(0.0, std::abs(p.x()) - 0.5 * footprint.length);
      const double dy = std::max(0.0, std::abs(p.y()) - 0.5 * footprint.width);
      if (std::hypot(dx, dy) > least + kCell) continue;
      const double h = 0.5 * kCell;
      const Polygon square = {middle + Eigen::Vector2d(-h, -h), middle + Eigen::Vector2d(h, -h), middle + Eigen::Vector2d(h, h),
                              middle + Eigen::Vector2d(-h, h)};
      least = std::min(least, convexDistance(body, square));
    }
  }
  return least;
}

bool World::touches(const Footprint& footprint, const Pose2& pose) const { return clearance(footprint, pose) <= 0.0; }

World randomBoxes(unsigned seed, double size, int boxes) {
  World world(size, size, false);
  world.fill(0, 0, size, 0.2, true);
  world.fill(0, size - 0.2, size, size, true);
  world.fill(0, 0, 0.2, size, true);
  world.fill(size - 0.2, 0, size, size, true);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(0.0, size), side(0.3, 2.0);
  for (int i = 0; i < boxes; ++i) {
    const double x = place(random), y = place(random), w = side(random), h = side(random);
    world.fill(x, y, x + w, y + h, true);
  }
  return world;
}

TrivialMap::TrivialMap(const GridFrame& frame) : frame_(frame) {
  evidence_.assign(static_cast<std::size_t>(frame.width * frame.height), 0);
  seen_.assign(evidence_.size(), 0);
}

void TrivialMap::add(const ObstacleScan& scan, const Pose2& T_odom_scan) {
  const Eigen::Vector2d from = T_odom_scan * scan.origin;
  for (std::size_t bin = 0; bin < scan.binCount(); ++bin) {
    const double range = static_cast<double>(scan.ranges[bin]);
    const bool hit = std::isfinite(range);
    const double reach = hit ? range : scan.range_max;
    const Eigen::Vector2d end = T_odom_scan * scan.pointAt(bin, reach);
    Eigen::Vector2i last(-1, -1);
    const Eigen::Vector2i target = frame_.cellOf(end);
    for (double r = 0.0; r < reach; r += 0.4 * kCell) {
      const Eigen::Vector2i cell = frame_.cellOf(from + (end - from) * (r / reach));
      if (cell == last || !frame_.contains(cell) || (hit && cell == target)) continue;
      last = cell;
      const auto i = static_cast<std::size_t>(frame_.indexOf(cell));
      seen_[i] = 1;
      evidence_[i] = static_cast<std::int8_t>(std::max(-4, evidence_[i] - 1));
    }
    if (!hit || !frame_.contains(target)) continue;
    const auto i = static_cast<std::size_t>(frame_.indexOf(target));
    seen_[i] = 1;
    evidence_[i] = static_cast<std::int8_t>(std::min(12, evidence_[i] + 3));
  }
}

LocalMap TrivialMap::window(const Eigen::Vector2d& middle, double stamp) const {
  LocalMap map;
  map.stamp = stamp;
  map.frame.resolution = kCell;
  map.frame.width = map.frame.height = static_cast<int>(std::lround(kWindow / kCell));
  const Eigen::Vector2i corner = frame_.cellOf(middle) - Eigen::Vector2i::Constant(map.frame.width / 2);
  map.frame.origin = frame_.origin + corner.cast<double>() * kCell;
  map.cells.assign(static_cast<std::size_t>(map.frame.width * map.frame.height), CellState::kUnknown);
  for (int y = 0; y < map.frame.height; ++y) {
    for (int x = 0; x < map.frame.width; ++x) {
      const Eigen::Vector2i cell = corner + Eigen::Vector2i(x, y);
      if (!frame_.contains(cell)) continue;
      const auto i = static_cast<std::size_t>(frame_.indexOf(cell));
      if (!seen_[i]) continue;
      map.cells[static_cast<std::size_t>(map.frame.indexOf({x, y}))] =
          evidence_[i] >= 2 ? CellState::kOccupied : CellState::kSeenFree;
    }
  }
  return map;
}

Route TrivialMap::route(const Eigen::Vector2d& from, const Eigen::Vector2d& goal) const {
  LocalMap all;
  all.frame = frame_;
  all.cells.assign(evidence_.size(), CellState::kUnknown);
  for (std::size_t i = 0; i < evidence_.size(); ++i) {
    if (seen_[i]) all.cells[i] = evidence_[i] >= 2 ? CellState::kOccupied : CellState::kSeenFree;
  }
  const Surroundings surroundings(all, {}, {}, {});
  PathSearchOptions options;
  options.least_clearance = 0.24;
  options.comfort_distance = 0.4;
  options.clearance_weight = 1.0;
  const FoundPath found = searchPath(surroundings, from, goal, {}, options);
  Route route;
  if (!found.reaches) return route;
  route.points = straightened(surroundings, found.points, 0.26);
  route.length = route.cost = pathLength(route.points);
  route.verdict = RouteVerdict::kThroughUnknown;
  return route;
}

ObstacleScan castScan(const World& world, const Pose2& pose, double stamp, double noise, std::mt19937& random) {
  ObstacleScan scan;
  scan.stamp = stamp;
  scan.range_max = kRange;
  scan.ranges.resize(kBeams);
  scan.transient.assign(kBeams, false);
  std::normal_distribution<double> error(0.0, 1.0);
  for (std::size_t bin = 0; bin < scan.ranges.size(); ++bin) {
    const double range = world.castRay(pose.position(), pose.yaw + scan.bearingOf(bin), kRange);
    scan.ranges[bin] = static_cast<float>(std::isfinite(range) ? std::max(0.05, range + noise * error(random)) : range);
    if (std::isfinite(range)) scan.points.push_back(scan.pointAt(bin, static_cast<double>(scan.ranges[bin])).cast<float>());
  }
  return scan;
}

RunResult drive(const World& world, const RunSettings& settings) {
  std::mt19937 random(settings.seed);
  Planner planner(settings.options, robotFootprint(), robotLimits());
  TrivialMap map(world.frame);
  RunResult result;
  SampledTrajectory committed;
  TrajectoryPoint state{0.0, settings.start, {}};
  Route route;
  bool touching = false;
  for (int tick = 0; tick * 0.1 < settings.duration && !result.arrived; ++tick) {
    const double now = tick * 0.1;
    const ObstacleScan scan = castScan(world, state.pose, now, settings.noise, random);
    map.add(scan, state.pose);
    if (tick % 3 == 0) route = map.route(state.pose.position(), settings.goal);
    const LocalMap window = map.window(state.pose.position(), now);
    const std::vector<TrackedObject> tracks;
    const std::clock_t begin = std::clock();
    const PlanResult plan = planner.plan({now, now + 0.05, Odometry{now, state.pose, state.twist, 0.0, 0.0}, window, scan,
                                          state.pose, tracks, route, settings.goal, 0.3, committed});
    result.plan_ms.push_back(1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
    if (!plan.keep_committed) result.committed.push_back(plan.trajectory);
    if (!plan.keep_committed && !plan.status.is(PlanCode::kDriving)) ++result.refusals;
    result.log.push_back(std::to_string(static_cast<int>(plan.status.code)) + (plan.keep_committed ? " keep " : " new ") +
                         plan.status.text);
    result.arrived = plan.status.is(PlanCode::kArrived);
    for (int k = 1; k <= 5; ++k) {
      const double time = now + 0.02 * k;
      if (time > now + 0.05 - 1e-9 && !plan.keep_committed) committed = plan.trajectory;
      const Eigen::Vector2d before = state.pose.position();
      if (!committed.empty()) state = committed.at(time);
      state.time = time;
      result.length += (state.pose.position() - before).norm();
      result.standing += std::abs(state.twist.speed) < 0.02 ? 0.02 : 0.0;
      const double clearance = world.clearance(robotFootprint(), state.pose);
      result.least_clearance = std::min(result.least_clearance, clearance);
      const bool touches = clearance <= 0.0;
      result.collisions += touches && !touching;
      touching = touches;
    }
    result.track.push_back(state);
    result.time = now + 0.1;
  }
  result.final_distance = (state.pose.position() - settings.goal).norm();
  return result;
}

}  // namespace parley

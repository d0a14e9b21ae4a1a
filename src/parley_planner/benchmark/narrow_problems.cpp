// SPDX-License-Identifier: BSD-3-Clause
#include "narrow_problems.h"

#include <array>
#include <cmath>
#include <queue>

#include "cost_to_go.h"
#include "narrow_search.h"
#include "scenes.h"

namespace parley::study {

namespace {

constexpr double kMiddle = 5.0;       // [m] of the world, both ways
constexpr double kNeck = 0.3;         // [m] a gap's length where it is narrower than the slot behind it
constexpr double kLongestWay = 3.0;   // [m] as far ahead as the planner lets the search lead
constexpr double kFloodCell = 0.025;  // [m]
constexpr int kFloodHeadings = 96;    // [-]

using Random = std::mt19937;

double draw(Random& random, double low, double high) { return low + (high - low) * static_cast<double>(random()) / 4294967296.0; }

struct Box {
  double x1, y1, x2, y2;  // [m]
  bool contains(const Eigen::Vector2d& p) const { return p.x() > x1 && p.x() < x2 && p.y() > y1 && p.y() < y2; }
};

/// Drawn upright round the origin; the world gets it turned by `slant`.
struct Scene {
  std::vector<Box> rooms, solids;
  Box start{};                  // the robot's middle is somewhere in it
  double start_heading = 0.0;   // [rad]
  double heading_spread = kPi;  // [rad] either way
  Eigen::Vector2d target = Eigen::Vector2d::Zero();
};

/// A slot of `width` that leads up from y = 0 at `x`, its first piece as wide as `gap`.
void addSlot(Scene& scene, double x, double width, double gap, double length) {
  scene.rooms.push_back({x - 0.5 * width, 0.0, x + 0.5 * width, length});
  scene.solids.push_back({x - 0.5 * width - 0.1, 0.0, x - 0.5 * gap, kNeck});
  scene.solids.push_back({x + 0.5 * gap, 0.0, x + 0.5 * width + 0.1, kNeck});
}

Scene slot(Random& random, double width, double gap) {
  Scene scene;
  const double half = draw(random, 0.55, 1.1), depth = draw(random, 0.95, 1.4);
  const double x = draw(random, 0.5 * width - half, half - 0.5 * width);
  scene.rooms.push_back({-half, -depth, half, 0.01});
  addSlot(scene, x, width, gap, 3.0);
  scene.start = {-half, -depth, half, 0.0};
  scene.target = {x, draw(random, 1.2, 2.2)};
  return scene;
}

Scene deadEnd(Random& random, double width, double gap) {
  Scene scene;
  const double length = draw(random, 1.4, 2.5), depth = draw(random, 0.9, 1.5);
  scene.rooms.push_back({-1.6, -depth, 1.6, 0.01});
  addSlot(scene, 0.0, width, gap, length);
  scene.start = {-0.1, length - 0.7, 0.1, length - 0.4};
  scene.start_heading = 0.5 * kPi;
  scene.heading_spread = 0.1;
  scene.target = {1.1, -0.5 * depth};
  return scene;
}

Scene door(Random& random, double gap) {
  Scene scene;
  const double below = draw(random, 0.9, 1.5), above = draw(random, 0.9, 1.5), wall = draw(random, 0.1, 0.5);
  const double x = draw(random, -1.0, 1.0);
  scene.rooms.push_back({-1.5, -below, 1.5, 0.0});
  scene.rooms.push_back({-1.5, wall, 1.5, wall + above});
  if (gap > 0.0) scene.rooms.push_back({x - 0.5 * gap, -0.01, x + 0.5 * gap, wall + 0.01});
  scene.start = {-1.5, -below, 1.5, 0.0};
  scene.target = {x + draw(random, -0.4, 0.4), wall + 0.5 * above};
  return scene;
}

Scene pocket(Random& random, double width, double gap) {
  Scene scene;
  scene.rooms.push_back({-1.2, -2.4, 1.2, 0.01});
  const double x = draw(random, -0.8, 0.8);
  for (int boxes = 3 + static_cast<int>(random() % 3); boxes > 0; --boxes) {
    const double left = draw(random, -1.2, 1.0), low = draw(random, -2.4, -0.4);
    scene.solids.push_back({left, low, left + draw(random, 0.15, 0.5), low + draw(random, 0.15, 0.5)});
  }
  addSlot(scene, x, width, gap, 3.0);
  scene.start = {-1.2, -2.4, 1.2, 0.0};
  scene.target = {x, draw(random, 1.2, 1.8)};
  return scene;
}

Scene sceneOf(Place place, Random& random, double width, double gap) {
  switch (place) {
    case Place::kSlot:
      return slot(random, width, gap);
    case Place::kDeadEnd:
      return deadEnd(random, width, gap);
    case Place::kDoor:
      return door(random, gap);
    default:
      return pocket(random, width, gap);
  }
}

World worldOf(const Scene& scene, const Pose2& T_world_scene) {
  World world(2.0 * kMiddle, 2.0 * kMiddle, true);
  const Pose2 T_scene_world = T_world_scene.inverse();
  const auto inAny = [](const std::vector<Box>& boxes, const Eigen::Vector2d& p) {
    return std::any_of(boxes.begin(), boxes.end(), [&p](const Box& box) { return box.contains(p); });
  };
  for (int i = 0; i < static_cast<int>(world.solid.size()); ++i) {
    const Eigen::Vector2d p = T_scene_world * world.frame.centerOf({i % world.frame.width, i / world.frame.width});
    world.solid[static_cast<std::size_t>(i)] = !inAny(scene.rooms, p) || inAny(scene.solids, p);
  }
  return world;
}

}  // namespace

const char* nameOf(Place place) {
  const std::array<const char*, kPlaces> names{"slot", "dead end", "door", "pocket"};
  return names.at(static_cast<std::size_t>(place));
}

NarrowProblem narrowProblem(unsigned seed, double clearance) {
  const FootprintProbe probe(robotFootprint());
  Random random(seed);
  const auto place = static_cast<Place>(seed % kPlaces);
  const bool closed = seed / kPlaces % 5 == 0, plugged = seed / kPlaces % 2 == 0;
  while (true) {  // until a start is found that is free; some drawn dead ends have none
    const double width = draw(random, 0.5, 0.8), narrow = draw(random, 0.25, 0.38);
    const Scene scene = sceneOf(place, random, width, !closed ? width : plugged ? 0.0 : narrow);
    const bool upright = place != Place::kDoor && random() % 2 == 0;
    const Pose2 T_world_scene{kMiddle, kMiddle,
                              upright ? 0.5 * kPi * static_cast<double>(random() % 4) : draw(random, -kPi, kPi)};
    NarrowProblem problem{place, closed, worldOf(scene, T_world_scene), {}, T_world_scene * scene.target, {}};
    problem.surroundings = Surroundings(seenMap(problem.world), {}, {}, {});
    const CostToGo guide(problem.surroundings, problem.target, probe.inscribedRadius() - 0.04, 2.0 * kLongestWay);
    for (int attempt = 0; attempt < 100; ++attempt) {
      const double heading = scene.start_heading + draw(random, -scene.heading_spread, scene.heading_spread);
      const Pose2 pose{draw(random, scene.start.x1, scene.start.x2), draw(random, scene.start.y1, scene.start.y2), heading};
      problem.start = T_world_scene * pose;
      const double way = guide.at(problem.start.position());
      if (std::isfinite(way) ? way > kLongestWay : !closed) continue;
      if (probe.clearance(problem.surroundings.obstacles(), problem.start) >= clearance + 0.001) return problem;
    }
  }
}

bool isOpen(const NarrowProblem& problem, const FootprintProbe& probe, double clearance) {
  using State = std::array<int, 3>;
  const int side = static_cast<int>(2.0 * kMiddle / kFloodCell);
  std::vector<bool> known(static_cast<std::size_t>(side * side * kFloodHeadings));
  std::queue<State> open;
  const auto visit = [&](const State& state) {
    const auto index = static_cast<std::size_t>((state[0] * side + state[1]) * kFloodHeadings + state[2]);
    if (known[index]) return;
    known[index] = true;
    const double yaw = problem.start.yaw + 2.0 * kPi / kFloodHeadings * state[2];
    const Pose2 pose{problem.start.x + kFloodCell * (state[0] - side / 2), problem.start.y + kFloodCell * (state[1] - side / 2),
                     yaw};
    if (probe.clearance(problem.surroundings.obstacles(), pose) >= clearance) open.push(state);
  };
  visit({side / 2, side / 2, 0});
  while (!open.empty()) {
    const State s = open.front();
    open.pop();
    const Eigen::Vector2d p = problem.start.position() + kFloodCell * Eigen::Vector2d(s[0] - side / 2, s[1] - side / 2);
    if ((p - problem.target).norm() < kTargetRadius) return true;
    for (const int step : {-1, 1}) {
      if (s[0] + step > 0 && s[0] + step < side) visit({s[0] + step, s[1], s[2]});
      if (s[1] + step > 0 && s[1] + step < side) visit({s[0], s[1] + step, s[2]});
      visit({s[0], s[1], (s[2] + step + kFloodHeadings) % kFloodHeadings});
    }
  }
  return false;
}

}  // namespace parley::study

// SPDX-License-Identifier: BSD-3-Clause
#include "parley_sim/encounter_counter.h"

#include <algorithm>

namespace parley::sim {
namespace {

constexpr double kLongEnough = 1.0;  // [s] in sight to make an encounter
constexpr double kForgotten = 5.0;   // [s] out of sight to end one
constexpr double kSameTime = 1e-9;   // [s]

}  // namespace

EncounterCounter::EncounterCounter(const Scenario& scenario, const World& world) : world_(&world) {
  for (const RobotSpec& robot : scenario.robots) ranges_.push_back(robot.lidar.range);
}

bool EncounterCounter::inSight(const Snapshot& snapshot, std::size_t first, std::size_t second) const {
  const Eigen::Vector2d from = snapshot.bodies[first].state.pose.position();
  const Eigen::Vector2d to = snapshot.bodies[second].state.pose.position();
  const double gap = (to - from).norm();
  if (gap > std::min(ranges_[first], ranges_[second]) || !world_->inSight(from, to)) return false;
  return std::none_of(snapshot.doors.begin(), snapshot.doors.end(), [&](const Box& door) {
    const auto inside = gap > 0.0 ? crossing(door, from, (to - from) / gap) : std::nullopt;
    return inside && inside->leave > 0.0 && inside->enter < gap;
  });
}

void EncounterCounter::note(const Snapshot& snapshot, std::size_t first, std::size_t second, Sight& sight) {
  if (!inSight(snapshot, first, second)) return;
  const double now = snapshot.time;
  const bool unbroken = sight.last >= last_observed_ - kSameTime;
  if (!unbroken) sight.since = now;
  sight.last = now;
  const bool under_way = now <= sight.gone + kSameTime;
  if (!under_way && now - sight.since < kLongEnough - kSameTime) return;
  if (!under_way) {
    const Eigen::Vector2d middle =
        0.5 * (snapshot.bodies[first].state.pose.position() + snapshot.bodies[second].state.pose.position());
    sight.encounter = encounters_.size();
    encounters_.push_back({first, second, sight.since, now, middle});
  }
  sight.gone = encounters_[sight.encounter].end = now + kForgotten;
}

void EncounterCounter::observe(const Snapshot& snapshot) {
  for (std::size_t i = 0; i < snapshot.bodies.size(); ++i) {
    for (std::size_t j = i + 1; j < snapshot.bodies.size(); ++j) {
      if (snapshot.bodies[i].present && snapshot.bodies[j].present) note(snapshot, i, j, sights_[{i, j}]);
    }
  }
  last_observed_ = snapshot.time;
}

}  // namespace parley::sim

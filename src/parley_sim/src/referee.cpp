// SPDX-License-Identifier: BSD-3-Clause
#include "parley_sim/referee.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace parley::sim {
namespace {

constexpr double kStandingSpeed = 0.02;       // [m/s]
constexpr double kStandingTurnRate = 0.02;    // [rad/s]
constexpr double kStandingTime = 0.5;         // [s]
constexpr double kTouchedSpeed = 0.05;        // [m/s] slower than this, being hit is no fault
constexpr double kClearanceOfInterest = 2.0;  // [m]
constexpr double kRelease = 0.005;            // [m] bodies nearer than this after a contact are still in it
constexpr double kSameTime = 1e-9;            // [s]

bool stands(const Twist2& twist) {
  return std::abs(twist.speed) < kStandingSpeed && std::abs(twist.turn_rate) < kStandingTurnRate;
}

}  // namespace

Referee::Referee(const Scenario& scenario, const World& world)
    : scenario_(scenario), world_(&world), standing_(scenario.robots.size(), 0.0), records_(scenario.robots.size()) {
  for (const RobotSpec& robot : scenario.robots) last_positions_.push_back(robot.start.position());
}

void Referee::noteJoined(std::size_t robot, double time) { records_[robot].joined_at = time; }

void Referee::judge(const Snapshot& snapshot, const std::vector<Pose2>& believed, double dt) {
  judgeContacts(snapshot);
  judgeProgress(snapshot, believed, dt);
}

std::set<Referee::Pair> Referee::contactsOf(const Snapshot& snapshot) const {
  std::set<Pair> contacts;
  const std::vector<Body>& bodies = snapshot.bodies;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!bodies[i].present) continue;
    const Box box = bodies[i].box();
    if (touchesSolid(*world_, snapshot.doors, box)) contacts.insert({ContactKind::kStatic, i, 0});
    for (std::size_t j = i + 1; j < bodies.size(); ++j) {
      const double reach = bodies[j].length + bodies[j].width + box.circumradius();
      if (!bodies[j].present || (bodies[j].state.pose.position() - box.center).norm() > reach) continue;
      if (overlap(box, bodies[j].box())) contacts.insert({ContactKind::kRobot, i, j});
    }
    for (std::size_t j = 0; j < snapshot.discs.size(); ++j) {
      if (overlap(box, snapshot.discs[j])) contacts.insert({ContactKind::kMoving, i, j});
    }
  }
  return contacts;
}

bool Referee::isLingering(const Snapshot& snapshot, const Pair& pair) const {
  const auto [kind, robot, other] = pair;
  const Box box = snapshot.bodies[robot].box();
  if (kind == ContactKind::kRobot) return distance(box, snapshot.bodies[other].box()) < kRelease;
  if (kind == ContactKind::kMoving) return distance(box, snapshot.discs[other]) < kRelease;
  Box grown = box;
  grown.half_length += kRelease;
  grown.half_width += kRelease;
  return touchesSolid(*world_, snapshot.doors, grown);
}

void Referee::judgeContacts(const Snapshot& snapshot) {
  std::set<Pair> contacts = contactsOf(snapshot);
  for (const Pair& pair : contacts_) {
    if (isLingering(snapshot, pair)) contacts.insert(pair);
  }
  for (const Pair& pair : contacts) {
    if (contacts_.count(pair) > 0) continue;
    const auto [kind, robot, other] = pair;
    const BodyState& state = snapshot.bodies[robot].state;
    const bool touched = kind == ContactKind::kMoving && std::abs(state.twist.speed) < kTouchedSpeed;
    incidents_.push_back({snapshot.time, kind, robot, other, touched, state.pose.position()});
  }
  contacts_ = std::move(contacts);
}

bool Referee::isAtGoal(std::size_t robot, const Pose2& truth, const Pose2& believed) const {
  const RobotSpec& spec = scenario_.robots[robot];
  const double miss =
      scenario_.judge == Judge::kTruth ? (truth.position() - spec.goal).norm() : (believed.position() - spec.goalInOdom()).norm();
  return miss <= scenario_.goal_tolerance;
}

void Referee::judgeProgress(const Snapshot& snapshot, const std::vector<Pose2>& believed, double dt) {
  for (std::size_t i = 0; i < records_.size(); ++i) {
    const Body& body = snapshot.bodies[i];
    RobotRecord& record = records_[i];
    if (!body.present) continue;
    const double limit = std::min(record.min_clearance, kClearanceOfInterest);
    record.min_clearance = std::min(record.min_clearance, clearance(*world_, snapshot, i, limit));
    const Eigen::Vector2d position = body.state.pose.position();
    const double moved = (position - last_positions_[i]).norm();
    last_positions_[i] = position;
    if (record.reached || record.killed) continue;
    record.length += moved;
    record.time = snapshot.time - record.joined_at;
    if (std::abs(body.state.twist.speed) < kStandingSpeed) record.stopped += dt;
    const bool holds = stands(body.state.twist) && isAtGoal(i, body.state.pose, believed[i]);
    standing_[i] = holds ? standing_[i] + dt : 0.0;
    record.reached = standing_[i] >= kStandingTime - kSameTime;
  }
}

int Referee::collisions(ContactKind kind) const {
  return static_cast<int>(
      std::count_if(incidents_.begin(), incidents_.end(), [kind](const Incident& i) { return i.kind == kind && !i.touched; }));
}

int Referee::touched() const {
  return static_cast<int>(std::count_if(incidents_.begin(), incidents_.end(), [](const Incident& i) { return i.touched; }));
}

bool Referee::allReached() const {
  return std::all_of(records_.begin(), records_.end(), [](const RobotRecord& r) { return r.reached || r.killed; });
}

bool Referee::success() const { return allReached() && static_cast<int>(incidents_.size()) == touched(); }

}  // namespace parley::sim

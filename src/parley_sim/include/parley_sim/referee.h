// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <optional>
#include <set>
#include <tuple>
#include <vector>

#include "parley_sim/contacts.h"
#include "parley_sim/scenario.h"

namespace parley::sim {

enum class ContactKind { kStatic, kRobot, kMoving };

/// The beginning of a contact.
struct Incident {
  double time = 0.0;  // [s]
  ContactKind kind = ContactKind::kStatic;
  std::size_t robot = 0;
  std::size_t other = 0;                               // robot or moving obstacle
  bool touched = false;                                // by a moving obstacle, while it stood: no fault of its own
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // [m] of the robot
};

/// What a robot has achieved so far.
struct RobotRecord {
  bool reached = false;
  bool killed = false;
  double joined_at = 0.0;                                          // [s]
  double time = 0.0;                                               // [s] from there to its arrival, or up to now
  double length = 0.0;                                             // [m] driven until its arrival, or up to now
  double stopped = 0.0;                                            // [s] stood until its arrival, or up to now
  double min_clearance = std::numeric_limits<double>::infinity();  // [m] to anything it could hit, over the whole run
};

/// Judges a run by the true state alone: contacts, arrivals, and what each robot needed. Shares no code with the robots.
class Referee {
 public:
  Referee(const Scenario& scenario, const World& world);

  /// To be called after every physics step. `believed`: where each robot's odometry says it is, in its odom frame.
  void judge(const Snapshot& snapshot, const std::vector<Pose2>& believed, double dt);

  void noteJoined(std::size_t robot, double time);
  void noteKilled(std::size_t robot) { records_[robot].killed = true; }

  const std::vector<Incident>& incidents() const { return incidents_; }
  const std::vector<RobotRecord>& records() const { return records_; }
  int collisions(ContactKind kind) const;
  int touched() const;
  /// Every robot that was not killed has been at its goal.
  bool allReached() const;
  bool success() const;

 private:
  /// A pair in contact: kind, robot, and the other where there is one.
  using Pair = std::tuple<ContactKind, std::size_t, std::size_t>;

  void judgeContacts(const Snapshot& snapshot);
  void judgeProgress(const Snapshot& snapshot, const std::vector<Pose2>& believed, double dt);
  std::set<Pair> contactsOf(const Snapshot& snapshot) const;
  /// Whether a pair that was in contact is apart by less than counts as an end of it.
  bool isLingering(const Snapshot& snapshot, const Pair& pair) const;
  bool isAtGoal(std::size_t robot, const Pose2& truth, const Pose2& believed) const;

  Scenario scenario_;
  const World* world_;
  std::vector<Eigen::Vector2d> last_positions_;
  std::vector<double> standing_;  // [s] for how long within the goal's tolerance
  std::vector<RobotRecord> records_;
  std::set<Pair> contacts_;
  std::vector<Incident> incidents_;
};

}  // namespace parley::sim

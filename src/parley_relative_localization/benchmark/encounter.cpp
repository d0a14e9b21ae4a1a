// SPDX-License-Identifier: BSD-3-Clause
#include "encounter.h"

#include <utility>

#include "conversation.h"

namespace parley::study {
namespace {

constexpr double kRadio = 10.0;  // [m]

class Run {
 public:
  Run(const GridWorld& world, const StudyOptions& options, unsigned seed, bool elsewhere)
      : world_(world), options_(options), random_(seed), elsewhere_(elsewhere), conversation_(options, random_()) {}

  bool place() { return elsewhere_ ? placeElsewhere() : placeMeeting(); }

  /// Robots that were to be elsewhere came near each other on their way.
  bool haveMet() const { return have_met_; }

  Outcome run() {
    for (int step = 0; step * kPeriod < kLongest; ++step) {
      const double now = step * kPeriod;
      drive();
      const Conversation::Robots robots{movers_[0].state(), movers_[1].state()};
      for (std::size_t i = 0; i < 2; ++i) conversation_.see(i, robots[i], scan(i, now));
      const double distance = (robots[0].truth.position() - robots[1].truth.position()).norm();
      conversation_.talk(now, robots, elsewhere_ || distance < kRadio);
      conversation_.weigh(now, robots);
      have_met_ = have_met_ || distance < options_.lidar.range + 1.0;
      conversation_.watch(now, robots, !elsewhere_ && seeEachOther());
      if (conversation_.isOver(now)) break;
    }
    return conversation_.outcome();
  }

 private:
  void add(const Eigen::Vector2d& start, const Eigen::Vector2d& goal, const Footprint& footprint, double speed) {
    movers_.emplace_back(world_, start, goal, footprint, speed, options_.drift, random_());
  }

  /// A place so far from `p` by the way that robots drive.
  std::optional<Eigen::Vector2d> placeAt(const GoalField& field, double least, double most) {
    for (int attempt = 0; attempt < 400; ++attempt) {
      const Eigen::Vector2d p = world_.place(0.4, random_);
      if (field.distance(p) >= least && field.distance(p) <= most) return p;
    }
    return std::nullopt;
  }

  /// Robots start `least` to 8 m from a place and pass it on the way to somewhere else.
  bool placePair(const Eigen::Vector2d& meeting, double least) {
    const GoalField field(world_, meeting, 0.3);
    const auto a = placeAt(field, least, 8.0), b = placeAt(field, least, 8.0), goal = placeAt(field, 3.0, 12.0);
    if (!a || !b || !goal || (*a - *b).norm() < 3.0) return false;
    const bool swap = random_() % 2 == 0;
    add(*a, swap ? *b : *goal, test::kRobot, options_.speed * speedFactor());
    add(*b, *a, test::kRobot, options_.speed * speedFactor());
    return true;
  }

  double speedFactor() { return 0.6 + 0.1 * static_cast<double>(random_() % 8); }

  void finishPlacing() {
    for (int i = 0; i < options_.clutter; ++i) {
      const GoalField field(world_, movers_.front().truth().position(), 0.3);
      const auto start = placeAt(field, 1.0, 10.0), goal = placeAt(field, 1.0, 10.0);
      if (start && goal) add(*start, *goal, {0.4, 0.4}, 1.0);
    }
  }

  bool placeMeeting() {
    movers_.clear();
    const Eigen::Vector2d meeting = world_.place(0.4, random_);
    if (!placePair(meeting, 3.0)) return false;
    if (random_() % 3 == 0) {
      const GoalField field(world_, meeting, 0.3);
      const auto start = placeAt(field, 1.0, 6.0), goal = placeAt(field, 3.0, 10.0);
      if (start && goal) add(*start, *goal, test::kRobot, options_.speed * speedFactor());
    }
    finishPlacing();
    return true;
  }

  bool placeElsewhere() {
    movers_.clear();
    const Eigen::Vector2d here = world_.place(0.4, random_), there = world_.place(0.4, random_);
    if ((here - there).norm() < kNearMiss || !placePair(here, 1.5) || !placePair(there, 1.5)) return false;
    std::swap(movers_[1], movers_[2]);  // robots 0 and 1 talk, 2 and 3 are those that they meet
    finishPlacing();
    return true;
  }

  void drive() {
    constexpr int kParts = 5;
    for (int part = 0; part < kParts; ++part) {
      for (Mover& mover : movers_) {
        std::vector<const Mover*> others;
        for (const Mover& other : movers_) {
          if (&other != &mover) others.push_back(&other);
        }
        mover.step(kPeriod / kParts, others);
      }
    }
  }

  /// What robot i sees.
  ObstacleScan scan(std::size_t i, double now) {
    const test::WallRange walls = [this](const Eigen::Vector2d& from, const Eigen::Vector2d& direction, double limit) {
      return world_.range(from, direction, limit);
    };
    std::vector<test::Body> bodies;
    for (const Mover& other : movers_) {
      const bool is_near = (other.truth().position() - movers_[i].truth().position()).norm() < options_.lidar.range + 1.0;
      if (&other != &movers_[i] && is_near) bodies.push_back(other.body());
    }
    return test::simulatedScan(walls, bodies, movers_[i].truth(), now, options_.lidar, random_);
  }

  bool seeEachOther() const {
    const Eigen::Vector2d a = movers_[0].truth().position(), b = movers_[1].truth().position();
    const double distance = (a - b).norm();
    return distance < options_.lidar.range && world_.range(a, (b - a) / distance, distance) > distance;
  }

  const GridWorld& world_;
  const StudyOptions& options_;
  std::mt19937 random_;
  bool elsewhere_;
  std::vector<Mover> movers_;
  Conversation conversation_;
  bool have_met_ = false;
};

std::optional<Outcome> simulate(const GridWorld& world, const StudyOptions& options, unsigned seed, bool elsewhere) {
  Run run(world, options, seed, elsewhere);
  for (int attempt = 0; attempt < 20; ++attempt) {
    if (!run.place()) continue;
    const Outcome outcome = run.run();
    return elsewhere && run.haveMet() ? std::nullopt : std::optional<Outcome>(outcome);
  }
  return std::nullopt;
}

}  // namespace

std::optional<Outcome> runEncounter(const GridWorld& world, const StudyOptions& options, unsigned seed) {
  return simulate(world, options, seed, false);
}

std::optional<Outcome> runElsewhere(const GridWorld& world, const StudyOptions& options, unsigned seed) {
  return simulate(world, options, seed, true);
}

}  // namespace parley::study

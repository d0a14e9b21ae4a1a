// SPDX-License-Identifier: BSD-3-Clause
#include "log_replay.h"

#include <algorithm>

#include "conversation.h"
#include "log_view.h"

namespace parley::study {
namespace {

constexpr int kReach = 16;           // [-] scans of a stretch either way of the meeting: about 10 m
constexpr double kLead = 5.0;        // [s] from the start to the meeting
constexpr double kBackOff = 1.6;     // [m]
constexpr double kTouch = 0.9;       // [m] bodies that came nearer could touch: the run ends
constexpr double kElsewhere = 10.0;  // [m] between stretches in different places

class Replay {
 public:
  Replay(const CarmenLog& log, const ReplayOptions& options, unsigned seed)
      : log_(log), options_(options), random_(seed), conversation_(options.study, random_()) {}

  void add(int scan) {
    constexpr double kSlowest = 0.5, kStep = 0.1;  // [-] of the study's speed
    const double speed = options_.study.speed * (kSlowest + kStep * static_cast<double>(random_() % 6));
    drives_.emplace_back(log_, stretchAbout(log_, scan, kReach, random_() % 2 == 0), speed, kLead);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    odometries_.push_back({20.0 * unit(random_), 20.0 * unit(random_), kPi * unit(random_)});
  }

  /// Robots 0 and 1 talk; 0 meets 1, or 0 meets 2 and 1 meets 3.
  Outcome run() {
    const bool together = drives_.size() == 2;
    for (int step = 0; step * kPeriod < kLongest && !haveTouched(); ++step) {
      const double now = step * kPeriod;
      if (step > 0) drive();
      const Conversation::Robots robots{stateOf(0), stateOf(1)};
      for (std::size_t i = 0; i < 2; ++i) scan(i, robots[i], now);
      conversation_.talk(now, robots, true);
      conversation_.weigh(now, robots);
      conversation_.watch(now, robots, together && seesOther(0, 1) && seesOther(1, 0));
      if (conversation_.isOver(now)) break;
    }
    return conversation_.outcome();
  }

 private:
  RobotState stateOf(std::size_t i) const {
    return {drives_[i].truth(), odometries_[i], drives_[i].twist(), drives_[i].travel()};
  }

  double distance(std::size_t i, std::size_t j) const {
    return (drives_[i].truth().position() - drives_[j].truth().position()).norm();
  }

  /// Whom robot i is to meet.
  std::size_t otherOf(std::size_t i) const { return drives_.size() == 2 ? 1 - i : (i + 2) % 4; }

  bool haveTouched() const { return distance(0, otherOf(0)) < kTouch || distance(1, otherOf(1)) < kTouch; }

  void drive() {
    std::vector<bool> backs_off;
    for (std::size_t i = 0; i < drives_.size(); ++i) backs_off.push_back(distance(i, otherOf(i)) < kBackOff);
    for (std::size_t i = 0; i < drives_.size(); ++i) {
      const Pose2 before = drives_[i].truth();
      const double travel = drives_[i].travel();
      drives_[i].step(kPeriod, backs_off[i]);
      odometries_[i] = driftedOdometry(odometries_[i], before.inverse() * drives_[i].truth(), drives_[i].travel() - travel,
                                       options_.study.drift, random_);
    }
  }

  void scan(std::size_t i, const RobotState& robot, double now) {
    std::vector<const LogScan*> scans = drives_[i].scans();
    if (options_.scans_alone) {
      const LogScan* passed = now == 0.0 ? scans.front() : drives_[i].passed();
      if (passed == nullptr) return;
      scans = {passed};
    }
    std::vector<test::Body> bodies;
    const LogDrive& other = drives_[otherOf(i)];
    if (options_.paint) bodies.push_back({test::kRobot, other.truth(), std::abs(other.twist().speed) > 0.1});
    const LogView view = viewFrom(robot.truth, scans, options_.study.lidar.beams, options_.study.lidar.range);
    conversation_.see(i, robot, paintedScan(view, bodies, now, options_.study.lidar, random_));
  }

  bool seesOther(std::size_t i, std::size_t j) const {
    const LogView view = viewFrom(drives_[i].truth(), drives_[i].scans(), options_.study.lidar.beams, options_.study.lidar.range);
    const Eigen::Vector2d p = drives_[i].truth().inverse() * drives_[j].truth().position();
    const auto bins = static_cast<double>(view.ranges.size());
    const auto bin = static_cast<std::size_t>((std::atan2(p.y(), p.x()) + kPi) / (2.0 * kPi) * bins) % view.ranges.size();
    return p.norm()<options_.study.lidar.range&& static_cast<double>(view.seen_to[bin])> p.norm();
  }

  const CarmenLog& log_;
  const ReplayOptions& options_;
  std::mt19937 random_;
  Conversation conversation_;
  std::vector<LogDrive> drives_;
  std::vector<Pose2> odometries_;
};

}  // namespace

std::optional<Outcome> replayEncounter(const CarmenLog& log, const std::vector<Meeting>& meetings, const ReplayOptions& options,
                                       unsigned seed) {
  std::mt19937 random(seed);
  if (meetings.empty()) return std::nullopt;
  const Meeting meeting = meetings[random() % meetings.size()];
  const bool swap = random() % 2 == 0;
  Replay replay(log, options, random());
  replay.add(swap ? meeting.second : meeting.first);
  replay.add(swap ? meeting.first : meeting.second);
  return replay.run();
}

std::optional<Outcome> replayElsewhere(const CarmenLog& log, const std::vector<Meeting>& meetings, const ReplayOptions& options,
                                       unsigned seed) {
  std::mt19937 random(seed);
  if (meetings.empty()) return std::nullopt;
  const Meeting here = meetings[random() % meetings.size()], there = meetings[random() % meetings.size()];
  for (const int a : {here.first, here.second}) {
    for (const int b : {there.first, there.second}) {
      const Stretch one = stretchAbout(log, a, kReach, false), other = stretchAbout(log, b, kReach, false);
      if (distanceBetween(log, one, other) < kElsewhere) return std::nullopt;
    }
  }
  Replay replay(log, options, random());
  for (const int scan : {here.first, there.first, here.second, there.second}) replay.add(scan);
  return replay.run();
}

}  // namespace parley::study

// SPDX-License-Identifier: BSD-3-Clause
// Two robots that may meet: robot 0 hears robot 1 over a radio that loses messages, and is judged on what it then believes.
#pragma once

#include <array>
#include <deque>
#include <set>

#include "parley_relative_localization/relative_localization.h"
#include "study.h"

namespace parley::study {

class Conversation {
 public:
  using Robots = std::array<RobotState, 2>;

  /// `options` must outlive it.
  Conversation(const StudyOptions& options, unsigned seed);

  /// What robot i's lidar stage saw; the stamp is the true time.
  void see(std::size_t i, const RobotState& robot, ObstacleScan scan);
  void talk(double now, const Robots& robots, bool in_range);
  /// Robot 0's step, judged.
  void weigh(double now, const Robots& robots);
  /// To be told in each period whether there is a line of sight between the robots.
  void watch(double now, const Robots& robots, bool sight);
  /// Nothing more is to come of this encounter.
  bool isOver(double now) const { return last_sight_ >= 0.0 && now > last_sight_ + kAfter; }
  Outcome outcome() const;

 private:
  /// What is on its way from robot 1 to robot 0.
  struct Message {
    double arrival = 0.0;  // [s]
    MotionReport motion;
    std::vector<SightReport> sights;
    std::vector<Keyframe> keyframes;
  };

  Message compose(double now, const RobotState& robot);
  void send(Message message);
  void deliver(double now);
  void judge(const PeerEstimate& estimate, double now, const Robots& robots);

  const StudyOptions& options_;
  std::mt19937 random_;
  std::vector<RelativeLocalization> localizers_;
  double offset_ = 0.0, phase_ = 0.0;  // [s]
  std::deque<Message> messages_;
  std::set<int> arrived_;                          // [-] keyframes
  double next_message_ = 0.0;                      // [s]
  double first_sight_ = -1.0, last_sight_ = -1.0;  // [s]
  double travel_at_sight_ = 0.0;                   // [m]
  int scans_in_sight_ = 0;                         // [-]
  double arrived_travel_ = -1e9;                   // [m] robot 1's, when a keyframe last arrived
  PoseState state_ = PoseState::kUnknown, state_heard_ = PoseState::kUnknown;
  Outcome outcome_;
};

}  // namespace parley::study

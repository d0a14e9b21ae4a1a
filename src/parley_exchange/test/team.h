// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "parley_exchange/exchange.h"
#include "random_content.h"

namespace parley {

/// The defaults, but for contours that need not stay as they are before they are published.
inline ExchangeOptions tellingAtOnce() {
  ExchangeOptions options;
  options.contour_settle = 0.0;
  return options;
}

/// Robots with a radio between them, in steps of 50 ms. Who reaches whom, how much is lost and the clocks are the test's.
class Team {
 public:
  struct Member {
    std::unique_ptr<Exchange> exchange;
    double clock_offset = 0.0;  // [s] its clock minus the team's
    bool on = true;
    std::vector<ExchangeEvent> events;
  };

  explicit Team(std::uint64_t seed = 1) : random_(seed) {}

  /// Returns its index; names are robot_0, robot_1, ... unless told.
  std::size_t add(double clock_offset = 0.0, std::uint32_t boot = 1, const std::string& name = "");
  void connect(std::size_t a, std::size_t b) { links_.insert({std::min(a, b), std::max(a, b)}); }
  void cut(std::size_t a, std::size_t b) { links_.erase({std::min(a, b), std::max(a, b)}); }
  void connectAll();

  /// Steps for `duration` seconds.
  void run(double duration);
  /// Once all robots have read `now`, and before they step.
  template <class Each>
  void run(double duration, const Each& each) {
    for (const double end = now + duration; now < end - 1e-9;) {
      for (std::size_t i = 0; i < members.size(); ++i) each(i);
      turn();
    }
  }

  Exchange& operator[](std::size_t i) { return *members[i].exchange; }
  /// That robot's own time. [s]
  double timeOf(std::size_t i) const { return now + members[i].clock_offset; }
  std::int64_t recordBytes(std::size_t i) const;
  int eventCount(std::size_t i, ExchangeEventKind kind) const;

  std::vector<Member> members;
  double now = 100.0;          // [s]
  double loss = 0.0;           // [-]
  double delay_least = 0.005;  // [s]
  double delay_most = 0.03;    // [s]
  ExchangeOptions options = tellingAtOnce();
  std::vector<std::pair<double, std::size_t>> sent;  // [s] and [byte] with headers, of all
  std::vector<std::vector<std::pair<double, std::size_t>>> sent_by;

 private:
  struct InFlight {
    double time;
    std::size_t receiver;
    Bytes packet;
  };
  void turn();
  void broadcast(std::size_t from, const Bytes& packet);

  RandomContent random_;
  std::set<std::pair<std::size_t, std::size_t>> links_;
  std::multimap<double, InFlight> air_;
};

/// A robot at a pose, standing.
Odometry standing(const Pose2& pose, double stamp);

/// A straight wall from (x, y), `length` along x, with a key.
OwnContour wall(std::int64_t key, double x, double y, double length, double seen = 0.0);

}  // namespace parley

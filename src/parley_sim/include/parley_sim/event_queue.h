// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "parley_sim/scenario.h"

namespace parley::sim {

/// Whether two door events speak of the same segment.
bool sameDoor(const Event& a, const Event& b);

/// A scenario's events in the order of their time. One that cannot happen yet waits and is tried again.
class EventQueue {
 public:
  explicit EventQueue(const std::vector<Event>& events) : upcoming_(events) {}

  /// Tries all whose time has come; `happens` says whether the event took place. A door that opens while it still waits
  /// to close does not close any more.
  void advance(double time, const std::function<bool(const Event&)>& happens);

 private:
  std::vector<Event> upcoming_;  // by time
  std::size_t next_ = 0;
  std::vector<Event> waiting_;
};

}  // namespace parley::sim

// SPDX-License-Identifier: BSD-3-Clause
#include "parley_sim/event_queue.h"

#include <algorithm>

namespace parley::sim {

bool sameDoor(const Event& a, const Event& b) { return (a.from == b.from && a.to == b.to) || (a.from == b.to && a.to == b.from); }

void EventQueue::advance(double time, const std::function<bool(const Event&)>& happens) {
  constexpr double kSameTime = 1e-9;  // [s]
  for (; next_ < upcoming_.size() && upcoming_[next_].time <= time + kSameTime; ++next_) {
    const Event& event = upcoming_[next_];
    const auto revoked = [&event](const Event& earlier) {
      return event.kind == EventKind::kDoor && earlier.kind == EventKind::kDoor && sameDoor(event, earlier);
    };
    waiting_.erase(std::remove_if(waiting_.begin(), waiting_.end(), revoked), waiting_.end());
    waiting_.push_back(event);
  }
  std::vector<Event> still_waiting;
  for (const Event& event : waiting_) {
    if (!happens(event)) still_waiting.push_back(event);
  }
  waiting_ = std::move(still_waiting);
}

}  // namespace parley::sim

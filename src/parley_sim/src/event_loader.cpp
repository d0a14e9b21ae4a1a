// SPDX-License-Identifier: BSD-3-Clause
#include "event_loader.h"

#include <algorithm>
#include <array>
#include <set>

namespace parley::sim {
namespace {

struct KindOfEvent {
  const char* key;
  EventKind kind;
  bool lasts;
};

constexpr std::array<KindOfEvent, 6> kKinds{{{"kill", EventKind::kKill, false},
                                             {"stall", EventKind::kStall, true},
                                             {"mute", EventKind::kMute, true},
                                             {"blind", EventKind::kBlind, true},
                                             {"join", EventKind::kJoin, false},
                                             {"door", EventKind::kDoor, false}}};

const KindOfEvent& kindOf(const YamlSection& section) {
  const KindOfEvent* found = nullptr;
  for (const KindOfEvent& candidate : kKinds) {
    if (!section.has(candidate.key)) continue;
    if (found != nullptr)
      section.fail(candidate.key, std::string("stands beside '") + found->key + "', one event has one of them");
    found = &candidate;
  }
  if (found == nullptr) section.fail("kill", "is missing; an event has one of kill, stall, mute, blind, join, door");
  return *found;
}

std::size_t robotNamed(YamlSection& section, const char* key, const std::vector<RobotSpec>& robots) {
  const std::string name = section.text(key, "");
  const auto found = std::find_if(robots.begin(), robots.end(), [&name](const RobotSpec& r) { return r.name == name; });
  if (found == robots.end()) section.fail(key, "there is no robot '" + name + "'");
  return static_cast<std::size_t>(found - robots.begin());
}

Event readEvent(YamlSection section, const std::vector<RobotSpec>& robots) {
  const KindOfEvent& what = kindOf(section);
  section.require("time");
  Event event;
  event.kind = what.kind;
  event.time = section.number("time", 0.0, {0.0, 1e6});
  if (what.kind == EventKind::kDoor) {
    const std::vector<Eigen::Vector2d> ends = section.points("door", 2);
    if (ends.size() != 2 || ends[0] == ends[1]) section.fail("door", "must be two different points");
    event.from = ends[0];
    event.to = ends[1];
    section.require("state");
    event.closed = section.choice("state", 0, {"closed", "open"}) == 0;
  } else {
    event.robot = robotNamed(section, what.key, robots);
  }
  if (what.lasts) {
    section.require("for");
    event.duration = section.number("for", 0.0, {0.0, 1e6});
  }
  section.finish();
  return event;
}

}  // namespace

std::vector<Event> readEvents(const std::vector<YamlSection>& sections, const std::vector<RobotSpec>& robots) {
  std::vector<Event> events;
  std::set<std::size_t> joined;
  for (const YamlSection& section : sections) {
    events.push_back(readEvent(section, robots));
    if (events.back().kind != EventKind::kJoin) continue;
    if (!joined.insert(events.back().robot).second) section.fail("join", "this robot joins twice");
  }
  std::stable_sort(events.begin(), events.end(), [](const Event& a, const Event& b) { return a.time < b.time; });
  return events;
}

}  // namespace parley::sim

// SPDX-License-Identifier: BSD-3-Clause
#include "team.h"

#include <algorithm>

namespace parley {
namespace {

constexpr double kTurn = 0.05;  // [s]

}  // namespace

std::size_t Team::add(double clock_offset, std::uint32_t boot, const std::string& name) {
  ExchangeIdentity identity;
  identity.name = name.empty() ? "robot_" + std::to_string(members.size()) : name;
  identity.boot = boot;
  identity.key = simulatedTeamKey(7);
  identity.footprint = {0.8, 0.4};
  identity.limits = {2.0, 1.57, 2.0, 4.0};
  Member member;
  member.exchange = std::make_unique<Exchange>(options, identity);
  member.clock_offset = clock_offset;
  members.push_back(std::move(member));
  sent_by.emplace_back();
  return members.size() - 1;
}

void Team::connectAll() {
  for (std::size_t i = 0; i < members.size(); ++i) {
    for (std::size_t j = i + 1; j < members.size(); ++j) connect(i, j);
  }
}

void Team::run(double duration) {
  run(duration, [](std::size_t) {});
}

void Team::turn() {
  now += kTurn;
  while (!air_.empty() && air_.begin()->first <= now) {
    const InFlight packet = air_.begin()->second;
    air_.erase(air_.begin());
    if (members[packet.receiver].on) {
      members[packet.receiver].exchange->addPacket(packet.packet, packet.time + members[packet.receiver].clock_offset);
    }
  }
  for (std::size_t i = 0; i < members.size(); ++i) {
    if (!members[i].on) continue;
    ExchangeOutput output = members[i].exchange->step(timeOf(i));
    members[i].events.insert(members[i].events.end(), output.events.begin(), output.events.end());
    for (const Bytes& packet : output.packets) broadcast(i, packet);
  }
}

void Team::broadcast(std::size_t from, const Bytes& packet) {
  sent.emplace_back(now, packet.size() + 28);
  sent_by[from].emplace_back(now, packet.size() + 28);
  for (std::size_t to = 0; to < members.size(); ++to) {
    if (to == from || links_.count({std::min(from, to), std::max(from, to)}) == 0 || random_.chance(loss)) continue;
    const double arrival = now + random_.real(delay_least, delay_most);
    air_.emplace(arrival, InFlight{arrival, to, packet});
  }
}

std::int64_t Team::recordBytes(std::size_t i) const {
  const SectionBytes& sections = members[i].exchange->counters().sections_sent;
  return static_cast<std::int64_t>(sections.map + sections.keyframe);
}

int Team::eventCount(std::size_t i, ExchangeEventKind kind) const {
  return static_cast<int>(std::count_if(members[i].events.begin(), members[i].events.end(),
                                        [kind](const ExchangeEvent& event) { return event.kind == kind; }));
}

Odometry standing(const Pose2& pose, double stamp) { return {stamp, pose, {}, 0.0, 0.0}; }

OwnContour wall(std::int64_t key, double x, double y, double length, double seen) {
  return {key, {{x, y}, {x + 0.5 * length, y}, {x + length, y}}, false, false, seen};
}

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#include "parley_sim/radio.h"

#include <algorithm>

namespace parley::sim {
namespace {

constexpr double kBurst = 0.25;          // [s] of bandwidth that a sender may use at once
constexpr double kLargestPacket = 1500;  // [byte] one of these must always fit
constexpr double kSameTime = 1e-9;       // [s]

double capacity(const RadioSpec& spec) { return std::max(kBurst * spec.bandwidth, kLargestPacket); }

}  // namespace

Radio::Radio(const Scenario& scenario, const World& world) : world_(&world), seed_(scenario.seed) {
  for (const RobotSpec& robot : scenario.robots) {
    names_.push_back(robot.name);
    specs_.push_back(robot.radio);
    buckets_.push_back({capacity(robot.radio), 0.0});
  }
  counters_.tx_bytes.assign(names_.size(), 0);
  counters_.rx_bytes.assign(names_.size(), 0);
}

bool Radio::fits(std::size_t sender, double bytes, double time) {
  const RadioSpec& spec = specs_[sender];
  if (spec.bandwidth == 0.0) return true;
  Bucket& bucket = buckets_[sender];
  bucket.bytes = std::min(capacity(spec), bucket.bytes + spec.bandwidth * (time - bucket.time));
  bucket.time = time;
  if (bucket.bytes < bytes) return false;
  bucket.bytes -= bytes;
  return true;
}

bool Radio::reaches(std::size_t sender, std::size_t receiver, const std::vector<RadioNode>& nodes) const {
  if (receiver == sender || !nodes[receiver].on) return false;
  const Eigen::Vector2d& from = nodes[sender].position;
  const Eigen::Vector2d& to = nodes[receiver].position;
  if ((to - from).norm() > specs_[sender].range) return false;
  return !specs_[sender].line_of_sight || world_->inSight(from, to);
}

RandomStream& Radio::link(std::size_t sender, std::size_t receiver) {
  const auto key = std::make_pair(sender, receiver);
  const auto found = links_.find(key);
  if (found != links_.end()) return found->second;
  return links_.emplace(key, RandomStream(seed_, names_[receiver], "radio from " + names_[sender])).first->second;
}

void Radio::send(std::size_t sender, const Payload& payload, double time, const std::vector<RadioNode>& nodes) {
  if (!nodes[sender].on) return;
  const std::int64_t bytes = static_cast<std::int64_t>(payload.size()) + kPacketOverhead;
  const bool sent = fits(sender, static_cast<double>(bytes), time);
  if (sent) {
    counters_.tx_bytes[sender] += bytes;
    ++counters_.packets_sent;
  } else {
    ++counters_.packets_over_bandwidth;
  }
  const RadioSpec& spec = specs_[sender];
  for (std::size_t receiver = 0; receiver < nodes.size(); ++receiver) {
    if (!reaches(sender, receiver, nodes)) continue;
    ++counters_.expected;
    RandomStream& stream = link(sender, receiver);
    const bool lucky = stream.uniform() < spec.success_rate;
    const double delay = std::max(0.0, spec.latency + stream.uniform(-spec.jitter, spec.jitter));
    if (sent && lucky) in_flight_.emplace(time + delay, InFlight{receiver, payload});
  }
}

std::vector<std::vector<Payload>> Radio::deliver(double time, const std::vector<RadioNode>& nodes) {
  std::vector<std::vector<Payload>> arrived(nodes.size());
  const auto end = in_flight_.upper_bound(time + kSameTime);
  for (auto it = in_flight_.begin(); it != end; ++it) {
    InFlight& packet = it->second;
    if (!nodes[packet.receiver].on) continue;
    ++counters_.received;
    counters_.rx_bytes[packet.receiver] += static_cast<std::int64_t>(packet.payload.size()) + kPacketOverhead;
    arrived[packet.receiver].push_back(std::move(packet.payload));
  }
  in_flight_.erase(in_flight_.begin(), end);
  return arrived;
}

}  // namespace parley::sim

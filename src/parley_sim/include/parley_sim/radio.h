// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "parley_sim/random_stream.h"
#include "parley_sim/scenario.h"
#include "parley_sim/world.h"

namespace parley::sim {

using Payload = std::vector<std::uint8_t>;

constexpr std::int64_t kPacketOverhead = 28;  // [byte] of IP and UDP headers

/// A robot as the radio sees it.
struct RadioNode {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // [m]
  bool on = false;
};

/// Bytes on the wire and packets of the whole run.
struct RadioCounters {
  std::vector<std::int64_t> tx_bytes;  // per robot
  std::vector<std::int64_t> rx_bytes;
  std::int64_t packets_sent = 0;
  std::int64_t packets_over_bandwidth = 0;  // never left the robot
  std::int64_t expected = 0;                // packets times receivers in range
  std::int64_t received = 0;
};

/// Broadcast with loss, delay and a limit of bytes. A sender's own settings hold for what it sends.
class Radio {
 public:
  Radio(const Scenario& scenario, const World& world);

  /// Puts a packet on the air at `time` for every node in range then.
  void send(std::size_t sender, const Payload& payload, double time, const std::vector<RadioNode>& nodes);

  /// What arrives by `time`, per robot, in the order of arrival; a node that is off by then hears nothing.
  std::vector<std::vector<Payload>> deliver(double time, const std::vector<RadioNode>& nodes);

  const RadioCounters& counters() const { return counters_; }

 private:
  struct InFlight {
    std::size_t receiver;
    Payload payload;
  };
  struct Bucket {
    double bytes = 0.0;
    double time = 0.0;  // [s] of the last refill
  };

  bool fits(std::size_t sender, double bytes, double time);
  bool reaches(std::size_t sender, std::size_t receiver, const std::vector<RadioNode>& nodes) const;
  RandomStream& link(std::size_t sender, std::size_t receiver);

  const World* world_;
  std::uint64_t seed_;
  std::vector<std::string> names_;
  std::vector<RadioSpec> specs_;
  std::vector<Bucket> buckets_;
  std::map<std::pair<std::size_t, std::size_t>, RandomStream> links_;
  std::multimap<double, InFlight> in_flight_;  // by the time of arrival
  RadioCounters counters_;
};

}  // namespace parley::sim

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <random>

#include "parley_exchange/transport.h"

namespace parley {

/// What a bad radio does to datagrams on their way out.
struct ChannelSettings {
  double loss = 0.0;         // [-] share lost, outside bursts
  double burst_begin = 0.0;  // [-] probability, per datagram, that a burst of losses begins
  double burst_end = 1.0;    // [-] the same that it ends
  double burst_loss = 1.0;   // [-] share lost in a burst
  double delay = 0.0;        // [s] least
  double jitter = 0.0;       // [s] up to so much more; datagrams may overtake each other
  double duplication = 0.0;  // [-] share that arrives twice
  double corruption = 0.0;   // [-] share that arrives with a bit changed
  double rate = 0.0;         // [byte/s] more than this is lost; 0 for no limit
  std::uint64_t seed = 1;
};

/// Puts a bad radio between a robot and a transport. The same seed and the same calls give the same losses.
class Channel : public Transport {
 public:
  /// Throws std::invalid_argument where the settings are out of range. `reaches` tells whether anybody is in range at a
  /// time; without it there always is.
  Channel(std::unique_ptr<Transport> inner, const ChannelSettings& settings, std::function<bool(double now)> reaches = {});

  bool send(const Bytes& datagram, double now) override;
  std::vector<Bytes> receive(double now) override;
  std::string problem() const override { return inner_->problem(); }

 private:
  bool isLost(std::size_t size, double now);
  void queue(const Bytes& datagram, double now);
  bool flush(double now);
  double uniform();

  std::unique_ptr<Transport> inner_;
  ChannelSettings settings_;
  std::function<bool(double)> reaches_;
  std::mt19937_64 engine_;
  bool in_burst_ = false;
  double allowance_ = 0.0;       // [byte] of the rate, at most one second's worth
  double allowance_time_ = 0.0;  // [s]
  bool has_sent_ = false;
  std::multimap<double, Bytes> under_way_;  // by the time of departure
};

}  // namespace parley

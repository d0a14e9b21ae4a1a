// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <map>
#include <optional>

#include "parley_exchange/exchange_options.h"
#include "parley_exchange/exchange_output.h"
#include "parley_exchange/seal.h"
#include "replay_window.h"
#include "token_bucket.h"

namespace parley {

/// What is remembered of a sender for good.
struct Sender {
  Sender(std::uint32_t first_boot, double packet_rate) : boot(first_boot), packets(packet_rate, packet_rate) {}

  std::uint32_t boot;  // the highest heard
  ReplayWindow window;
  TokenBucket packets;
  std::uint32_t stale_counter = 0;  // [-] highest with a lower boot
  int stale_advances = 0;           // [-] times that one rose: somebody sends under this name with a lower boot
};

/// A packet that is authentic and new.
struct OpenedPacket {
  FrameHeader header;
  Bytes plain;
};

/// Lets packets in: authentic, of the sender's last boot, never seen before, not too many. Counts what it drops.
class Receiver {
 public:
  Receiver(const ExchangeOptions& options, RobotId self, std::uint32_t boot);

  std::optional<OpenedPacket> open(const Bytes& frame, Sealer& sealer, double now, ExchangeCounters& counters);

  /// So that it is known when it comes back.
  void sent(std::uint32_t counter, const Bytes& frame);
  /// nullptr if nothing authentic has come from it.
  const Sender* find(RobotId id) const;
  /// A robot other than this one has sent under this one's name; asking clears it.
  bool takeOwnNameHeard();

 private:
  bool admits(const FrameHeader& header, double now, ExchangeCounters& counters);
  void hearOwnName(const FrameHeader& header, const Bytes& frame);

  ExchangeOptions options_;
  RobotId self_;
  std::uint32_t boot_;
  std::deque<std::pair<std::uint32_t, Bytes>> own_seals_;  // by counter
  std::map<RobotId, Sender> senders_;
  bool own_name_heard_ = false;
};

}  // namespace parley

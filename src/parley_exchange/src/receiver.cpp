// SPDX-License-Identifier: BSD-3-Clause
#include "receiver.h"

#include <algorithm>

namespace parley {
namespace {

constexpr std::size_t kOwnSeals = 256;  // [-] packets of our own that are recognised when they come back

Bytes sealOf(const Bytes& frame) { return Bytes(frame.end() - static_cast<std::ptrdiff_t>(kSealBytes), frame.end()); }

}  // namespace

Receiver::Receiver(const ExchangeOptions& options, RobotId self, std::uint32_t boot)
    : options_(options), self_(self), boot_(boot) {}

std::optional<OpenedPacket> Receiver::open(const Bytes& frame, Sealer& sealer, double now, ExchangeCounters& counters) {
  const std::optional<FrameHeader> header = readHeader(frame);
  if (!header) {
    ++counters.dropped_format;
    return std::nullopt;
  }
  std::optional<Bytes> plain = sealer.open(*header, frame);
  if (!plain) {
    ++counters.dropped_authentication;
    return std::nullopt;
  }
  if (header->sender == self_) {
    ++counters.dropped_own;
    hearOwnName(*header, frame);
    return std::nullopt;
  }
  if (!admits(*header, now, counters)) return std::nullopt;
  return OpenedPacket{*header, std::move(*plain)};
}

bool Receiver::admits(const FrameHeader& header, double now, ExchangeCounters& counters) {
  auto known = senders_.find(header.sender);
  if (known == senders_.end()) {
    if (senders_.size() >= static_cast<std::size_t>(options_.max_senders)) {
      ++counters.dropped_table;
      return false;
    }
    known = senders_.emplace(header.sender, Sender(header.boot, options_.max_packet_rate)).first;
  }
  Sender& sender = known->second;
  if (header.boot < sender.boot) {
    ++counters.dropped_boot;
    if (header.counter > sender.stale_counter) {
      sender.stale_counter = header.counter;
      ++sender.stale_advances;
    }
    return false;
  }
  if (header.boot > sender.boot) sender = Sender(header.boot, options_.max_packet_rate);
  if (!sender.window.accept(header.counter)) {
    ++counters.dropped_replay;
    return false;
  }
  if (sender.packets.level(now) < 1.0) {
    ++counters.dropped_rate;
    return false;
  }
  sender.packets.spend(1.0);
  return true;
}

void Receiver::hearOwnName(const FrameHeader& header, const Bytes& frame) {
  // A recording of an earlier run, or of long ago, is no namesake.
  if (header.boot < boot_) return;
  const auto own =
      std::find_if(own_seals_.begin(), own_seals_.end(), [&](const auto& seal) { return seal.first == header.counter; });
  const bool ahead = own_seals_.empty() || header.counter > own_seals_.back().first;
  if (header.boot > boot_ || ahead || (own != own_seals_.end() && own->second != sealOf(frame))) own_name_heard_ = true;
}

void Receiver::sent(std::uint32_t counter, const Bytes& frame) {
  own_seals_.emplace_back(counter, sealOf(frame));
  if (own_seals_.size() > kOwnSeals) own_seals_.pop_front();
}

const Sender* Receiver::find(RobotId id) const {
  const auto sender = senders_.find(id);
  return sender == senders_.end() ? nullptr : &sender->second;
}

bool Receiver::takeOwnNameHeard() {
  const bool heard = own_name_heard_;
  own_name_heard_ = false;
  return heard;
}

}  // namespace parley

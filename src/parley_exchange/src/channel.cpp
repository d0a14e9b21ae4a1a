// SPDX-License-Identifier: BSD-3-Clause
#include "parley_exchange/channel.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace parley {
namespace {

constexpr std::size_t kMaxUnderWay = 10000;  // [-] more are lost

void check(const ChannelSettings& s) {
  for (const double share : {s.loss, s.burst_begin, s.burst_end, s.burst_loss, s.duplication, s.corruption}) {
    if (!(share >= 0.0 && share <= 1.0)) throw std::invalid_argument("channel: a share or probability is not within 0 and 1");
  }
  for (const double amount : {s.delay, s.jitter, s.rate}) {
    if (!(amount >= 0.0) || std::isinf(amount))
      throw std::invalid_argument("channel: delay, jitter or rate is negative or infinite");
  }
}

}  // namespace

Channel::Channel(std::unique_ptr<Transport> inner, const ChannelSettings& settings, std::function<bool(double)> reaches)
    : inner_(std::move(inner)), settings_(settings), reaches_(std::move(reaches)), engine_(settings.seed) {
  check(settings);
}

double Channel::uniform() { return static_cast<double>(engine_() >> 11) * 0x1.0p-53; }

bool Channel::isLost(std::size_t size, double now) {
  // All is drawn whatever happens, so that one loss does not change what comes after.
  const double turn = uniform(), fate = uniform();
  in_burst_ = in_burst_ ? turn >= settings_.burst_end : turn < settings_.burst_begin;
  if (reaches_ && !reaches_(now)) return true;
  if (settings_.rate > 0.0) {
    const double gained = has_sent_ ? std::max(0.0, now - allowance_time_) * settings_.rate : settings_.rate;
    allowance_ = std::min(settings_.rate, allowance_ + gained);
    allowance_time_ = now;
    has_sent_ = true;
    if (allowance_ < static_cast<double>(size)) return true;
    allowance_ -= static_cast<double>(size);
  }
  return fate < (in_burst_ ? settings_.burst_loss : settings_.loss);
}

void Channel::queue(const Bytes& datagram, double now) {
  if (under_way_.size() >= kMaxUnderWay) return;
  const double wait = settings_.delay + settings_.jitter * uniform();
  Bytes bytes = datagram;
  if (uniform() < settings_.corruption && !bytes.empty()) {
    const std::uint64_t bit = engine_() % (8 * bytes.size());
    bytes[bit / 8] = static_cast<std::uint8_t>(bytes[bit / 8] ^ (1U << (bit % 8)));
  }
  under_way_.emplace(now + wait, std::move(bytes));
}

bool Channel::flush(double now) {
  bool sent = true;
  while (!under_way_.empty() && under_way_.begin()->first <= now) {
    sent = inner_->send(under_way_.begin()->second, now) && sent;
    under_way_.erase(under_way_.begin());
  }
  return sent;
}

bool Channel::send(const Bytes& datagram, double now) {
  const bool lost = isLost(datagram.size(), now), twice = uniform() < settings_.duplication;
  if (!lost) queue(datagram, now);
  if (!lost && twice) queue(datagram, now);
  return flush(now);
}

std::vector<Bytes> Channel::receive(double now) {
  flush(now);
  return inner_->receive(now);
}

}  // namespace parley

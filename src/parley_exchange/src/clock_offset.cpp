// SPDX-License-Identifier: BSD-3-Clause
#include "clock_offset.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "parley_exchange/records.h"

namespace parley {
namespace {

constexpr double kWindow = 8.0;           // [s]
constexpr double kEchoLife = 60.0;        // [s]
constexpr double kUsualDelay = 0.005;     // [s] on the air, until an echo tells
constexpr double kWorstDelay = 0.1;       // [s]
constexpr std::int32_t kJump = 10000;     // [ticks] a clock that was set
constexpr std::int32_t kLongest = 20000;  // [ticks] round trips are shorter

/// The difference of two readings modulo 2^32, with its sign.
std::int32_t minus(std::uint32_t a, std::uint32_t b) { return static_cast<std::int32_t>(a - b); }

}  // namespace

std::uint32_t ticksOf(double time) { return static_cast<std::uint32_t>(static_cast<std::int64_t>(std::llround(time / kTick))); }

void ClockOffset::heard(std::uint32_t stamp, double now) {
  const std::uint32_t difference = ticksOf(now) - stamp;
  const std::int64_t change = started_ ? minus(difference, reference_) : 0;
  if (!started_ || std::abs(change - least()) > kJump) {
    *this = ClockOffset();
    started_ = true;
    reference_ = difference;
    window_start_ = now;
    return;
  }
  if (now - window_start_ > kWindow || now < window_start_) {
    previous_ = current_;
    current_ = static_cast<std::int32_t>(change);
    window_start_ = now;
  }
  current_ = std::min(current_, static_cast<std::int32_t>(change));
}

void ClockOffset::echoed(std::uint32_t difference, double now) {
  echo_ = difference;
  echo_time_ = now;
  has_echo_ = started_ && roundTrip() >= -kLongest && roundTrip() <= kLongest;
}

std::optional<std::uint32_t> ClockOffset::difference() const {
  if (!started_) return std::nullopt;
  return reference_ + static_cast<std::uint32_t>(least());
}

std::int32_t ClockOffset::least() const { return std::min(current_, previous_); }

std::int32_t ClockOffset::roundTrip() const { return minus(echo_ + reference_ + static_cast<std::uint32_t>(least()), 0); }

bool ClockOffset::known(double now) const { return has_echo_ && now - echo_time_ < kEchoLife; }

double ClockOffset::error(double now) const { return known(now) ? 0.5 * kTick * std::max(0, roundTrip()) + kTick : kWorstDelay; }

double ClockOffset::ownTime(std::uint32_t stamp, double now) const {
  if (!started_) return now;
  // One way alone gives offset and delay in one; the echo splits them.
  const double delay = known(now) ? 0.5 * kTick * roundTrip() : kUsualDelay;
  const std::uint32_t arrival = stamp + reference_ + static_cast<std::uint32_t>(least());
  return now + kTick * minus(arrival, ticksOf(now)) - delay;
}

}  // namespace parley

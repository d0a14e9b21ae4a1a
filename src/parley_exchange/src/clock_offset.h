// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

namespace parley {

/// A clock's reading in ticks, modulo 2^32. [ticks]
std::uint32_t ticksOf(double time);

/// How far a peer's clock is ahead. Each side keeps the least (arrival - stamp) of the last seconds, which is the offset
/// with the shortest delay on the air added, and tells the other: half the difference of the two is the offset, and half
/// their sum bounds the error. Loss costs time only, no exchange has to succeed as a whole.
class ClockOffset {
 public:
  /// A packet stamped `stamp` [ticks, peer's clock] came at `now` [s, own clock].
  void heard(std::uint32_t stamp, double now);
  /// The peer's own least difference, for packets sent from here.
  void echoed(std::uint32_t difference, double now);

  /// The least difference, for the peer; nullopt before the first packet. [ticks]
  std::optional<std::uint32_t> difference() const;

  /// Both directions have been heard of within the last minute.
  bool known(double now) const;
  /// Bound of the offset's error; of one direction only, what a slow radio's delay could be. [s]
  double error(double now) const;
  /// The peer's time stamp on the own clock, taken to be within 59 hours of `now`. [s]
  double ownTime(std::uint32_t stamp, double now) const;

 private:
  std::int32_t least() const;
  std::int32_t roundTrip() const;

  bool started_ = false;
  std::uint32_t reference_ = 0;  // [ticks] the first difference; others are kept relative to it
  std::int32_t current_ = 0;     // [ticks] least of this window
  std::int32_t previous_ = 0;    // [ticks] least of the window before
  double window_start_ = 0.0;    // [s]
  std::uint32_t echo_ = 0;       // [ticks]
  double echo_time_ = 0.0;       // [s]
  bool has_echo_ = false;
};

}  // namespace parley

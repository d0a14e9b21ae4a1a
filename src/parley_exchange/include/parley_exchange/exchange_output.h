// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "parley_exchange/bit_stream.h"
#include "parley_exchange/packet_codec.h"

namespace parley {

constexpr double kDatagramOverhead = 28.0;  // [byte] of IP and UDP headers

enum class ExchangeEventKind { kPeerAppeared, kPeerLost, kPeerRestarted, kDuplicateName, kContourContested };

/// Something that the operator, or another stage, should know.
struct ExchangeEvent {
  ExchangeEventKind kind = ExchangeEventKind::kPeerAppeared;
  RobotId robot = 0;
  std::int64_t contour = 0;  // [-] key of the own contour that was contested
  std::string text;          // for people
};

/// What to put on the air now, each packet for everybody in reach, and what happened since the last step.
struct ExchangeOutput {
  std::vector<Bytes> packets;
  std::vector<ExchangeEvent> events;
};

/// Since the start. Whatever is dropped is in exactly one of these.
struct ExchangeCounters {
  std::int64_t packets_sent = 0;
  std::int64_t bytes_sent = 0;  // [byte] 28 a packet included
  SectionBytes sections_sent;   // [byte] payload by kind

  std::int64_t packets_received = 0;
  std::int64_t packets_accepted = 0;
  std::int64_t dropped_format = 0;          // no frame of this version
  std::int64_t dropped_own = 0;             // own packets that came back
  std::int64_t dropped_boot = 0;            // from before the sender's last start
  std::int64_t dropped_replay = 0;          // seen before, or too old to tell
  std::int64_t dropped_authentication = 0;  // another key, changed bits, a forged sender
  std::int64_t dropped_rate = 0;            // sender too busy
  std::int64_t dropped_table = 0;           // too many robots
  std::int64_t sections_malformed = 0;
  std::int64_t sections_unknown = 0;
  std::int64_t implausible = 0;  // messages or records that cannot be true
  std::int64_t records_received = 0;
  std::int64_t records_new = 0;
  std::int64_t records_refused = 0;  // over a limit, or contradicting others
  std::int64_t records_old_epoch = 0;
  std::int64_t inputs_refused = 0;    // from this robot's own stages
  std::int64_t contours_refused = 0;  // own ones that do not fit the format or the limits
};

}  // namespace parley

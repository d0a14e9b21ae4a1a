// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <map>
#include <optional>
#include <utility>

#include "parley_exchange/team_key.h"

namespace parley {

constexpr std::uint8_t kWireVersion = 1;  // [-]
constexpr std::size_t kHeaderBytes = 13;  // [byte] version, sender, boot, counter
constexpr std::size_t kSealBytes = 16;    // [byte] tag
constexpr std::size_t kFrameBytes = kHeaderBytes + kSealBytes;
constexpr std::size_t kMaxDatagram = 1100;  // [byte]

/// What a frame says in clear. It is authentic once the frame has been opened.
struct FrameHeader {
  RobotId sender = 0;
  std::uint32_t boot = 0;
  std::uint32_t counter = 0;  // [-] of this boot's packets, from 1
};

/// nullopt if it is no frame of this version, or too short or too long.
std::optional<FrameHeader> readHeader(const Bytes& frame);

/// ChaCha20-Poly1305 with a key for each sender and boot, derived from the team key.
class Sealer {
 public:
  explicit Sealer(const TeamKey& team_key);

  /// A counter must never be used twice in a boot.
  Bytes seal(const FrameHeader& header, const Bytes& plain);

  /// nullopt if the key is another one or a bit of the frame was changed.
  std::optional<Bytes> open(const FrameHeader& header, const Bytes& frame);

 private:
  using Key = std::array<std::uint8_t, 32>;
  const Key& keyOf(const FrameHeader& header);

  TeamKey team_key_;
  std::map<std::pair<RobotId, std::uint32_t>, Key> keys_;  // the last ones, so that a key is not derived for each packet
};

}  // namespace parley

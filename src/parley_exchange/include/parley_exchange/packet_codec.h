// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "parley_exchange/messages.h"

namespace parley {

/// What is on the wire in the sealed part, in docs/wire_format.md to the bit. Encoding needs content that passes the
/// checks; decoding takes any bytes: what cannot be read is left out and counted in the result.
Bytes encodePacket(const PacketContent& content);
PacketContent decodePacket(const Bytes& plain);

/// A packet in lines of text, the same for equal content.
std::string describe(const PacketContent& content);

/// Bytes of each kind in an encoded packet: what the sections take, their headers included.
struct SectionBytes {
  std::size_t beacon = 0;       // [byte] with echoes and digest
  std::size_t trajectory = 0;   // [byte]
  std::size_t conflict = 0;     // [byte] with intents
  std::size_t observation = 0;  // [byte]
  std::size_t map = 0;          // [byte] contours, anchors, edges, tombstones, contests, endorsements
  std::size_t keyframe = 0;     // [byte]

  SectionBytes& operator+=(const SectionBytes& other);
};
SectionBytes sectionBytes(const Bytes& plain);

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

namespace parley {

/// One datagram's payload, as it leaves one robot and reaches others.
struct Packet {
  std::vector<std::uint8_t> bytes;
};

}  // namespace parley

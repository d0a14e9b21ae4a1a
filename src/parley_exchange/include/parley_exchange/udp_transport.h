// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "parley_exchange/transport.h"

namespace parley {

/// Where UDP datagrams go and come from.
struct UdpSettings {
  std::uint16_t port = 0;                     // [-] bound, and sent to where a destination names none; 0 binds any
  std::string local = "0.0.0.0";              // address that is bound
  std::string broadcast = "255.255.255.255";  // of the link, such as 10.0.0.255; with `peers` given it is not used
  std::vector<std::string> peers;             // "address" or "address:port": unicast to each instead of broadcast
  bool share_port = false;                    // other programs of this machine may bind it too
};

/// UDP without waiting: broadcast on the link, never routed on, or unicast to a list. Own broadcasts come back; the
/// exchange knows them. Throws std::invalid_argument with a reason where the settings cannot be used.
std::unique_ptr<Transport> openUdp(const UdpSettings& settings);

/// The port that is bound, for tests that bind any. [-]
std::uint16_t boundPort(const Transport& udp);

}  // namespace parley

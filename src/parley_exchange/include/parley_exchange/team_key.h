// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "parley_exchange/records.h"

namespace parley {

/// What all robots of a team share.
using TeamKey = std::array<std::uint8_t, 32>;

/// From a file with 64 hexadecimal digits. Throws std::invalid_argument that names the file and the reason.
TeamKey loadTeamKey(const std::string& path);

/// From the digits themselves; white space around them is ignored. Throws std::invalid_argument.
TeamKey parseTeamKey(const std::string& digits);

/// For tests and the simulator: a key that follows from a number. Not a secret.
TeamKey simulatedTeamKey(std::uint64_t number);

/// First four bytes of the name's BLAKE2b-128.
RobotId robotIdOf(const std::string& name);

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "parley_exchange/bit_stream.h"

namespace parley {

/// Recorded datagrams: text with the hexadecimal bytes of one a line, where what follows '#' and lines with other text are
/// left out; or binary, each after its length in two bytes, big-endian. Throws std::invalid_argument where it is neither.
std::vector<Bytes> readDatagrams(const std::string& path);

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

namespace parley {

/// Raises the count of starts kept in a file and returns a robot's boot number: the count in the upper 20 bits, 12 random
/// ones below. The file is replaced in one step, and is on the disk before this returns. A file that is not there counts
/// as zero starts. Throws std::invalid_argument, naming the file and the reason, where it cannot be read or written.
std::uint32_t nextBoot(const std::string& path);

}  // namespace parley

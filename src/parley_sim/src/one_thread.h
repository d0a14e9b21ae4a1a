// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace parley::sim {

/// Has OpenCV work in this process without threads of its own: maps' windows are small, and runs go side by side.
void useOneThread();

}  // namespace parley::sim

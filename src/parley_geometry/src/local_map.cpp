// SPDX-License-Identifier: BSD-3-Clause
#include "parley_geometry/local_map.h"

namespace parley {

bool isConsistent(const LocalMap& map) {
  const GridFrame& frame = map.frame;
  if (!frame.origin.allFinite() || !std::isfinite(frame.resolution) || frame.resolution <= 0.0) return false;
  if (frame.width <= 0 || frame.height <= 0) return false;
  return map.cells.size() == static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height);
}

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "surface_check.h"

namespace parley {

/// Where the peer's submap fits into the own one without a first guess; nullopt where it fits nowhere, or in several places,
/// or slides. Histograms of normals give rotations, a pooled grid places, refinement and free space the verdict.
std::optional<PoseInformation> searchGlobally(const SurfaceMap& own, const SurfaceMap& peer,
                                              const RelativeLocalizationOptions& options);

}  // namespace parley

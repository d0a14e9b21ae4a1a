// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "free_space_check.h"
#include "parley_relative_localization/relative_localization_options.h"
#include "scan_matcher.h"

namespace parley {

/// A submap with what matching needs of it.
struct SurfaceMap {
  explicit SurfaceMap(std::vector<PlacedScan> scans);

  Submap submap;
  PointIndex index;                  // of the points that have a normal
  std::vector<SurfacePoint> sample;  // some of them
};

/// Surfaces of scans of which there are new ones all the time, worked out when they are asked for.
class OwnSurfaces {
 public:
  void set(std::vector<PlacedScan> scans) {
    scans_ = std::move(scans);
    map_.reset();
  }
  bool empty() const { return scans_.empty(); }
  /// Of the scans set last.
  const SurfaceMap& map() const {
    if (!map_) map_ = std::make_unique<SurfaceMap>(scans_);
    return *map_;
  }

 private:
  std::vector<PlacedScan> scans_;
  mutable std::unique_ptr<const SurfaceMap> map_;
};

/// What the surfaces that both robots saw say of a pose.
struct SurfaceVerdict {
  bool asked = false;        // there was something to ask
  bool agrees = false;       // enough matches, hardly any violation, and the refined pose is near the one asked about
  bool contradicts = false;  // one side looked through the other's walls
  bool objects = false;      // enough points to say, and they do not agree
  bool observed = false;     // in every direction
  PoseInformation estimate;  // refined; without information in a direction not observed
  FreeSpaceVote vote;
};

/// Refines a pose that robots got from seeing each other, and judges it by free space.
SurfaceVerdict checkSurfaces(const SurfaceMap& own, const SurfaceMap& peer, const PoseInformation& pose,
                             const RelativeLocalizationOptions& options);

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "parley_geometry/footprint.h"
#include "parley_geometry/scan.h"

namespace parley {

/// Picks the bins of a scan whose return lies on something.
class TransientMask {
 public:
  /// `scan` must outlive the mask.
  explicit TransientMask(const ObstacleScan& scan) : scan_(scan), bins_(scan.binCount(), false) {}

  void addDisc(const Eigen::Vector2d& center_base, double radius);
  /// Returns how many bins it picked that were not picked before.
  int addFootprint(const Pose2& T_base_other, const Footprint& footprint, double margin);

  const std::vector<bool>& bins() const { return bins_; }

 private:
  template <class Predicate>
  int addWhere(const Eigen::Vector2d& center_base, double radius, const Predicate& is_on);

  const ObstacleScan& scan_;
  std::vector<bool> bins_;
};

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "surroundings.h"

namespace parley {

/// Length of the shortest way to a target for a disc, from anywhere in the window: what guides searches that also mind the
/// heading. A flood over cells twice as large as the map's.
class CostToGo {
 public:
  /// The disc keeps `clearance` [m] from obstacles and stays where something was seen. Ways longer than `reach` [m] are none.
  CostToGo(const Surroundings& surroundings, const Eigen::Vector2d& target, double clearance, double reach);

  /// [m] never more than a shortest way has; infinite where there is none.
  double at(const Eigen::Vector2d& p) const;

 private:
  bool isFree(int x, int y) const;
  void flood(const Eigen::Vector2i& target, double reach);

  const Surroundings& surroundings_;
  double clearance_;
  GridFrame frame_;
  std::vector<float> lengths_;  // [m]
};

}  // namespace parley

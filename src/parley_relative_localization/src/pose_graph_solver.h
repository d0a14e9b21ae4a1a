// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "pose_graph.h"

namespace parley {

/// Solves for the anchors of all robots that `edges` join to the own one, with its newest anchor held.
std::map<std::string, GraphEstimate> solveAnchors(const std::string& own_name, const Anchor& own,
                                                  const std::vector<RelativeEdge>& edges,
                                                  const RelativeLocalizationOptions& options);

}  // namespace parley

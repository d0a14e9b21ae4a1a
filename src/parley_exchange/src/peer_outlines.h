// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <vector>

#include "parley_exchange/exchange.h"
#include "record_store.h"
#include "references.h"

namespace parley {

/// Confirmed peers' contours in this robot's odom frame, to see which own ones they have told already.
class PeerOutlines {
 public:
  explicit PeerOutlines(double distance) : distance_(distance) {}

  /// Draws anew what changed since the last call: a pose, or an origin's map by its revision.
  void update(const std::map<RobotId, PeerPose>& poses, const RecordStore& store, const References& references,
              const std::map<RobotId, int>& revisions);

  /// The contours of one peer that together have all of an outline within the distance and two sigma; empty if none has.
  std::vector<ContourName> covering(const Polygon& polygon, bool closed) const;
  std::uint32_t epochOf(RobotId origin) const;

 private:
  struct Outline {
    ContourName name;
    Polygon polygon;  // [m] odom frame
    bool closed = false;
    Eigen::Vector2d low = Eigen::Vector2d::Zero();   // [m] of its box
    Eigen::Vector2d high = Eigen::Vector2d::Zero();  // [m]
    double tolerance = 0.0;                          // [m]
  };
  struct Layer {
    std::uint32_t epoch = 0;
    int revision = -1;
    PoseEstimate T_odom_peer;
    std::vector<Outline> outlines;
  };

  void draw(Layer& layer, RobotId peer, const Log& log, const References& references) const;
  const Outline* near(const Layer& layer, const Eigen::Vector2d& point) const;

  double distance_;  // [m]
  std::map<RobotId, Layer> layers_;
};

}  // namespace parley

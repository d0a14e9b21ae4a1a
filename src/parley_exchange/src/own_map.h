// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <set>

#include "own_log.h"
#include "parley_exchange/exchange.h"
#include "peer_outlines.h"
#include "references.h"

namespace parley {

/// This robot's anchors and contours: what of them is published, anew, or no longer.
class OwnMap {
 public:
  OwnMap(const ExchangeOptions& options, OwnLog log) : options_(options), log_(log) {}

  /// Drops an anchor if the last one is too far away.
  void drive(const Pose2& T_odom_base, double now);
  bool moveAnchor(std::uint32_t id, const Pose2& T_odom_anchor, double now);
  /// nullopt before the first one.
  std::optional<std::uint32_t> nearestAnchor(const Eigen::Vector2d& p_odom) const;
  const std::map<std::uint32_t, Pose2>& anchors() const { return anchors_; }

  /// Returns how many were refused because they do not fit the format or the limits.
  int publish(const std::vector<OwnContour>& contours, const PeerOutlines& outlines, References& references, double now);

  /// The key of the contour that a record belongs to.
  std::optional<std::int64_t> keyOf(std::uint32_t record_id) const;

 private:
  struct Published {
    OwnContour given;                // as it came last
    std::uint32_t anchor = 0;        // [-]
    Polygon polygon;                 // [m] as published, in the anchor's frame
    std::vector<std::uint32_t> ids;  // [-] of the records; empty while a peer's contour stands for it
    bool settled = false;            // what is published agrees with `given`
    double looked_at = -1e9;         // [s] when it was last published or compared with peers' contours
    double appeared_at = 0.0;        // [s]
    double changed_at = 0.0;         // [s] when `given` was last another
    double missing_since = -1.0;     // [s] negative while it is there
  };

  bool update(Published& published, const OwnContour& contour, const PeerOutlines& outlines, References& references, double now);
  bool isDue(const Published& published, double now) const;
  bool differs(const Published& published, const OwnContour& contour) const;
  bool isContested(const Published& published, const References& references) const;
  bool write(Published& published, const OwnContour& contour, double now);
  void withdrawMissing(const std::set<std::int64_t>& present, double now);
  void writeAnchor(std::uint32_t id, const Pose2& pose, double distance, double now);

  ExchangeOptions options_;
  OwnLog log_;
  std::map<std::uint32_t, Pose2> anchors_;
  std::map<std::uint32_t, double> anchor_steps_;  // [m] way from the anchor before
  std::uint32_t current_anchor_ = 0;
  std::map<std::int64_t, Published> contours_;
};

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <vector>

#include "parley_relative_localization/exchange_records.h"
#include "peer_localizer.h"

namespace parley {

/// This robot's own side: sightings, motion, keyframes and the submap of the newest of them.
class OwnRecorder {
 public:
  OwnRecorder(const RelativeLocalizationOptions& options, const Footprint& footprint);

  /// False, and nothing changes, for a scan not newer than the last.
  bool add(const Pose2& T_odom_base, const ObstacleScan& scan);
  /// Brings the submap up to date with the newest scan.
  void refresh();
  void forgetBefore(double stamp);
  /// Says of each blob which known robot it is: name_of(stamp, place in odom) [s] [m], empty if none.
  template <class NameOf>
  void nameBlobs(const NameOf& name_of) {
    for (SightRecord& sight : view_.side.sights) {
      sight.owners.clear();
      for (const SightedBlob& blob : sight.blobs) sight.owners.push_back(name_of(sight.stamp, sight.T_odom_scan * blob.position));
    }
  }

  const OwnView& view() const { return view_; }
  /// The newest ones, newest first.
  std::vector<Keyframe> keyframes(std::size_t count) const;
  std::vector<SightReport> reports(double since, std::size_t count) const;

 private:
  bool isKeyframeDue(const Pose2& T_odom_scan) const;

  RelativeLocalizationOptions options_;
  OwnView view_;
  std::deque<PlacedScan> keyframes_;
  PlacedScan newest_;
  int next_id_ = 1;        // [-]
  bool is_stale_ = false;  // the submap lacks the newest scan
};

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "parley_geometry/footprint.h"
#include "parley_geometry/odometry_buffer.h"
#include "parley_geometry/scan.h"
#include "parley_geometry/status.h"
#include "parley_geometry/tracked_object.h"
#include "parley_lidar/lidar_options.h"

namespace parley {

enum class LidarCode {
  kOk,
  kEmpty,       // no valid beam or point in it
  kNoOdometry,  // odometry does not cover the scan's time
  kBadStamp,    // not finite, or not after the last scan
  kMalformed    // cannot be a lidar's reading
};

/// A peer whose place is known well enough to keep its returns off the map.
struct KnownTeammate {
  Pose2 pose_odom;  // at the end of the scan
  Footprint footprint;
  double margin = 0.0;  // [m] by which the footprint is grown: the pose's error
};

/// With any status but kOk there is no scan and there are no tracks.
struct LidarResult {
  Status<LidarCode> status;
  ObstacleScan scan;                  // in the base frame at the end of the scan
  std::vector<TrackedObject> tracks;  // all that is followed; velocity is zero unless moving
  int dropped_points = 0;             // [-] invalid or isolated returns
  int masked_points = 0;              // [-] bins whose return is on a known teammate
};

/// Turns a lidar's reading into the nearest obstacle in each direction, and follows what moves.
/// Same inputs in the same order, same results, bit for bit.
class LidarStage {
 public:
  /// Throws std::invalid_argument with all problems if an option is out of range.
  LidarStage(const LidarOptions& options, const Footprint& footprint, const LidarMount& mount);
  ~LidarStage();
  LidarStage(LidarStage&&) noexcept;
  LidarStage& operator=(LidarStage&&) noexcept;

  /// Odometry must cover the scan from first to last beam. A stamp older than the last scan's by less than a second is
  /// refused; by more, time went back and the stage resets itself.
  LidarResult process(const RangeScan& scan, const OdometryBuffer& odometry, const std::vector<KnownTeammate>& teammates);
  LidarResult process(const LidarCloud& cloud, const OdometryBuffer& odometry, const std::vector<KnownTeammate>& teammates);

  /// Forgets tracks and earlier scans; for when time went back or odometry jumped.
  void reset();

 private:
  class Pipeline;
  std::unique_ptr<Pipeline> pipeline_;
};

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#include "parley_lidar/lidar_stage.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "blob_finder.h"
#include "object_tracker.h"
#include "outlier_removal.h"
#include "planar_binning.h"
#include "scan_history.h"
#include "spatial_binning.h"
#include "transient_mask.h"
#include "voxel_thinning.h"

namespace parley {
namespace {

constexpr double kTimeReset = 1.0;  // [s] going back by more than this means that time started again

template <class Options>
std::string problemsOf(const Options& options, const char* name) {
  std::string text;
  for (const std::string& problem : checkOptions(options, name)) text += problem + "\n";
  return text;
}

void requireValid(const LidarOptions& options, const Footprint& footprint, const LidarMount& mount) {
  std::string text = problemsOf(options, "lidar") + problemsOf(footprint, "footprint") + problemsOf(mount, "lidar mount");
  if (options.min_height >= options.max_height) text += "lidar: min_height must be less than max_height\n";
  if (options.min_range >= options.max_range) text += "lidar: min_range must be less than max_range\n";
  if (options.blob_min_chord >= options.blob_max_chord) text += "lidar: blob_min_chord must be less than blob_max_chord\n";
  if (!text.empty()) throw std::invalid_argument(text);
}

LidarResult failure(LidarCode code, const std::string& text, int dropped = 0) {
  LidarResult result;
  result.status = {code, text};
  result.dropped_points = dropped;
  return result;
}

}  // namespace

class LidarStage::Pipeline {
 public:
  Pipeline(const LidarOptions& options, const Footprint& footprint, const LidarMount& mount)
      : options_(options),
        footprint_(footprint),
        mount_(mount),
        planar_(options, footprint, mount),
        history_(std::max(options.moving_window, options.outlier_memory)),
        tracker_(options) {}

  LidarResult process(const RangeScan& scan, const OdometryBuffer& odometry, const std::vector<KnownTeammate>& teammates) {
    const std::string problem = planarProblem(scan, options_);
    if (!problem.empty()) return failure(LidarCode::kMalformed, problem);
    const auto bin = [&](const ScanMotion& motion) { return planar_.bin(scan, motion); };
    return process(scan.stamp, durationOf(scan), odometry, teammates, bin);
  }

  LidarResult process(const LidarCloud& cloud, const OdometryBuffer& odometry, const std::vector<KnownTeammate>& teammates) {
    const auto bin = [&](const ScanMotion& motion) { return binCloud(cloud, motion, options_, footprint_, mount_); };
    return process(cloud.stamp, durationOf(cloud, options_), odometry, teammates, bin);
  }

  void reset() {
    history_.clear();
    tracker_.clear();
    last_stamp_ = -std::numeric_limits<double>::infinity();
  }

 private:
  template <class Binning>
  LidarResult process(double start, double duration, const OdometryBuffer& odometry, const std::vector<KnownTeammate>& teammates,
                      const Binning& bin) {
    const double stamp = start + duration;
    if (!std::isfinite(stamp)) return failure(LidarCode::kBadStamp, "the stamp is not finite");
    if (stamp < last_stamp_ - kTimeReset) reset();
    if (stamp <= last_stamp_) return failure(LidarCode::kBadStamp, "the scan is not newer than the last one");
    const std::optional<ScanMotion> motion = ScanMotion::over(odometry, start, duration, mount_);
    if (!motion) return failure(LidarCode::kNoOdometry, "odometry does not cover the time of the scan");
    const BinnedScan measured = bin(*motion);
    if (measured.valid == 0) return failure(LidarCode::kEmpty, "no valid return in the scan", measured.dropped);
    last_stamp_ = stamp;
    return finish(measured, stamp, motion->end().pose, teammates);
  }

  LidarResult finish(const BinnedScan& measured, double stamp, const Pose2& T_odom_base,
                     const std::vector<KnownTeammate>& teammates) {
    const BinnedScan clean =
        withoutOutliers(measured, T_odom_base, history_, stamp, options_.outlier_distance, options_.outlier_memory);
    history_.add(measured, stamp, T_odom_base);
    const std::vector<BlobShape> blobs = findBlobs(clean, options_);
    follow(blobs, stamp, T_odom_base);

    LidarResult result;
    result.dropped_points = clean.dropped;
    result.scan.stamp = stamp;
    result.scan.range_max = clean.range_max;
    result.scan.origin = clean.origin;
    result.scan.ranges = clean.ranges;
    result.scan.points = thinned(clean.points, options_.voxel_size);
    for (const BlobShape& shape : blobs) result.scan.blobs.push_back(shape.blob);
    result.tracks = trackedObjects();
    TransientMask mask(result.scan);
    result.masked_points = maskTeammates(mask, T_odom_base, teammates);
    maskTracks(mask, T_odom_base, stamp);
    result.scan.transient = mask.bins();
    result.scan.moving = movingBins(result.scan, T_odom_base, teammates);
    return result;
  }

  void follow(const std::vector<BlobShape>& blobs, double stamp, const Pose2& T_odom_base) {
    std::vector<Sighting> sightings;
    sightings.reserve(blobs.size());
    for (const BlobShape& shape : blobs) sightings.push_back(sightingOf(shape, T_odom_base, stamp));
    tracker_.update(std::move(sightings), history_, T_odom_base.position());
  }

  std::vector<TrackedObject> trackedObjects() const {
    std::vector<TrackedObject> objects;
    for (const Track& track : tracker_.tracks()) {
      objects.push_back(track.object());
      // A still thing's middle shifts as the view of it changes: that is no velocity.
      if (!track.object().moving) objects.back().velocity = Eigen::Vector2d::Zero();
    }
    return objects;
  }

  /// Keeps what moves, and what is too new to tell, off the map.
  void maskTracks(TransientMask& mask, const Pose2& T_odom_base, double stamp) const {
    const Pose2 T_base_odom = T_odom_base.inverse();
    for (const Track& track : tracker_.tracks()) {
      if (!track.object().moving && !tracker_.isUndecided(track, stamp)) continue;
      mask.addDisc(T_base_odom * track.predicted(), track.object().radius + options_.transient_margin);
    }
  }

  std::vector<bool> movingBins(const ObstacleScan& scan, const Pose2& T_odom_base,
                               const std::vector<KnownTeammate>& teammates) const {
    const Pose2 T_base_odom = T_odom_base.inverse();
    TransientMask mask(scan);
    for (const Track& track : tracker_.tracks()) {
      if (track.object().moving) mask.addDisc(T_base_odom * track.predicted(), track.object().radius);
    }
    for (const KnownTeammate& teammate : teammates) {
      if (teammate.pose_odom.isFinite()) mask.addFootprint(T_base_odom * teammate.pose_odom, teammate.footprint, 0.0);
    }
    return mask.bins();
  }

  int maskTeammates(TransientMask& mask, const Pose2& T_odom_base, const std::vector<KnownTeammate>& teammates) const {
    int masked = 0;
    for (const KnownTeammate& teammate : teammates) {
      if (!teammate.pose_odom.isFinite() || !(teammate.margin >= 0.0)) continue;
      masked += mask.addFootprint(T_odom_base.inverse() * teammate.pose_odom, teammate.footprint, teammate.margin);
    }
    return masked;
  }

  LidarOptions options_;
  Footprint footprint_;
  LidarMount mount_;
  PlanarBinning planar_;
  ScanHistory history_;
  ObjectTracker tracker_;
  double last_stamp_ = -std::numeric_limits<double>::infinity();  // [s]
};

LidarStage::LidarStage(const LidarOptions& options, const Footprint& footprint, const LidarMount& mount) {
  requireValid(options, footprint, mount);
  pipeline_ = std::make_unique<Pipeline>(options, footprint, mount);
}

LidarStage::~LidarStage() = default;
LidarStage::LidarStage(LidarStage&&) noexcept = default;
LidarStage& LidarStage::operator=(LidarStage&&) noexcept = default;

LidarResult LidarStage::process(const RangeScan& scan, const OdometryBuffer& odometry,
                                const std::vector<KnownTeammate>& teammates) {
  return pipeline_->process(scan, odometry, teammates);
}

LidarResult LidarStage::process(const LidarCloud& cloud, const OdometryBuffer& odometry,
                                const std::vector<KnownTeammate>& teammates) {
  return pipeline_->process(cloud, odometry, teammates);
}

void LidarStage::reset() { pipeline_->reset(); }

}  // namespace parley

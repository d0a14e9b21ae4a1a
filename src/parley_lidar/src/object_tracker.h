// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <vector>

#include "blob_finder.h"
#include "parley_geometry/tracked_object.h"
#include "scan_history.h"

namespace parley {

/// A blob in the odom frame.
struct Sighting {
  double stamp = 0.0;                                // [s]
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();  // [m]
  double radius = 0.0;                               // [m]
  std::vector<Eigen::Vector2d> points;               // [m]
};

/// At most `max_points` of the blob's returns are kept, evenly.
Sighting sightingOf(const BlobShape& shape, const Pose2& T_odom_base, double stamp, std::size_t max_points = 48);

/// A followed blob: position and velocity by a Kalman filter of constant velocity, the same for x and y.
class Track {
 public:
  Track(int id, const Sighting& sighting, const LidarOptions& options);

  void predict(double stamp);
  void update(const Sighting& sighting);
  void setMoving(double stamp);
  /// Ends `moving` once nothing has moved for the hold time.
  void settle(double stamp);

  const TrackedObject& object() const { return object_; }
  /// Where it should be now, seen or not.
  const Eigen::Vector2d& predicted() const { return predicted_; }
  const std::deque<Sighting>& sightings() const { return sightings_; }
  double firstSeen() const { return first_seen_; }

 private:
  LidarOptions options_;
  TrackedObject object_;
  Eigen::Vector2d predicted_;
  double predicted_stamp_;          // [s]
  double first_seen_;               // [s]
  double last_moved_ = 0.0;         // [s]
  double position_variance_;        // [m^2]
  double covariance_ = 0.0;         // [m^2/s]
  double velocity_variance_;        // [m^2/s^2]
  std::deque<Sighting> sightings_;  // within the moving window, oldest first
};

/// Follows blobs from scan to scan: nearest neighbour within a gate, closest pairs first.
class ObjectTracker {
 public:
  explicit ObjectTracker(const LidarOptions& options) : options_(options) {}

  /// `history` ends with the scan that the sightings are from. Sightings nearest to the robot come first when tracks run
  /// out.
  void update(std::vector<Sighting> sightings, const ScanHistory& history, const Eigen::Vector2d& robot_odom);

  const std::vector<Track>& tracks() const { return tracks_; }
  bool isUndecided(const Track& track, double stamp) const;
  /// Identifiers go on: none is used twice.
  void clear() { tracks_.clear(); }

 private:
  std::vector<bool> updateNearest(const std::vector<Sighting>& sightings, double stamp);

  LidarOptions options_;
  std::vector<Track> tracks_;
  int next_id_ = 1;
};

}  // namespace parley

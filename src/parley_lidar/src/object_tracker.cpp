// SPDX-License-Identifier: BSD-3-Clause
#include "object_tracker.h"

#include <algorithm>
#include <tuple>

#include "motion_evidence.h"

namespace parley {
namespace {

constexpr double kStartSpeed = 1.5;     // [m/s] standard deviation of a new track's velocity
constexpr double kShrinking = 0.95;     // [-] per sight: what is seen of a thing shrinks before the thing does
constexpr double kRound = 1e-9;         // [s]
constexpr std::size_t kSightings = 40;  // [-]

}  // namespace

Sighting sightingOf(const BlobShape& shape, const Pose2& T_odom_base, double stamp, std::size_t max_points) {
  Sighting sighting;
  sighting.stamp = stamp;
  sighting.middle = T_odom_base * shape.blob.position;
  sighting.radius = shape.radius;
  const std::size_t stride = std::max<std::size_t>(1, (shape.points.size() + max_points - 1) / max_points);
  for (std::size_t i = 0; i < shape.points.size(); i += stride) sighting.points.push_back(T_odom_base * shape.points[i]);
  return sighting;
}

Track::Track(int id, const Sighting& sighting, const LidarOptions& options)
    : options_(options),
      predicted_(sighting.middle),
      predicted_stamp_(sighting.stamp),
      first_seen_(sighting.stamp),
      position_variance_(options.track_noise * options.track_noise),
      velocity_variance_(kStartSpeed * kStartSpeed),
      sightings_{sighting} {
  object_.id = id;
  object_.stamp = sighting.stamp;
  object_.position = sighting.middle;
  object_.radius = sighting.radius;
  object_.observations = 1;
}

void Track::predict(double stamp) {
  const double dt = stamp - predicted_stamp_;
  const double q = options_.track_acceleration * options_.track_acceleration;
  predicted_ += object_.velocity * dt;
  position_variance_ += dt * (2.0 * covariance_ + dt * (velocity_variance_ + q * dt * dt / 4.0));
  covariance_ += dt * (velocity_variance_ + q * dt * dt / 2.0);
  velocity_variance_ += q * dt * dt;
  predicted_stamp_ = stamp;
}

void Track::update(const Sighting& sighting) {
  const double total = position_variance_ + options_.track_noise * options_.track_noise;
  const double position_gain = position_variance_ / total, velocity_gain = covariance_ / total;
  const Eigen::Vector2d innovation = sighting.middle - predicted_;
  predicted_ += position_gain * innovation;
  object_.velocity += velocity_gain * innovation;
  velocity_variance_ -= velocity_gain * covariance_;
  covariance_ *= 1.0 - position_gain;
  position_variance_ *= 1.0 - position_gain;
  object_.position = predicted_;
  object_.stamp = sighting.stamp;
  object_.radius = std::max(sighting.radius, kShrinking * object_.radius);
  ++object_.observations;
  sightings_.push_back(sighting);
  const double oldest = sighting.stamp - options_.moving_window - kRound;
  while (sightings_.size() > kSightings || sightings_.front().stamp < oldest) sightings_.pop_front();
}

void Track::setMoving(double stamp) {
  object_.moving = object_.has_moved = true;
  last_moved_ = stamp;
}

void Track::settle(double stamp) { object_.moving = object_.moving && stamp - last_moved_ <= options_.moving_hold; }

void ObjectTracker::update(std::vector<Sighting> sightings, const ScanHistory& history, const Eigen::Vector2d& robot_odom) {
  const double stamp = history.scans().back().stamp;
  for (Track& track : tracks_) track.predict(stamp);
  std::stable_sort(sightings.begin(), sightings.end(), [&](const Sighting& a, const Sighting& b) {
    return (a.middle - robot_odom).squaredNorm() < (b.middle - robot_odom).squaredNorm();
  });
  const std::vector<bool> taken = updateNearest(sightings, stamp);
  for (Track& track : tracks_) {
    if (track.object().stamp == stamp && hasMoved(track, history, options_)) track.setMoving(stamp);
    track.settle(stamp);
  }
  const auto is_old = [&](const Track& track) { return stamp - track.object().stamp > options_.track_memory + kRound; };
  tracks_.erase(std::remove_if(tracks_.begin(), tracks_.end(), is_old), tracks_.end());
  for (std::size_t i = 0; i < sightings.size() && tracks_.size() < static_cast<std::size_t>(options_.max_tracks); ++i) {
    if (!taken[i]) tracks_.emplace_back(next_id_++, sightings[i], options_);
  }
}

std::vector<bool> ObjectTracker::updateNearest(const std::vector<Sighting>& sightings, double stamp) {
  std::vector<std::tuple<double, std::size_t, std::size_t>> pairs;  // distance, track, sighting
  for (std::size_t t = 0; t < tracks_.size(); ++t) {
    const double gate = options_.track_gate + options_.track_top_speed * (stamp - tracks_[t].object().stamp);
    for (std::size_t s = 0; s < sightings.size(); ++s) {
      const double distance = (sightings[s].middle - tracks_[t].predicted()).norm();
      if (distance <= gate) pairs.emplace_back(distance, t, s);
    }
  }
  std::sort(pairs.begin(), pairs.end());
  std::vector<bool> updated(tracks_.size(), false), taken(sightings.size(), false);
  for (const auto& [distance, t, s] : pairs) {
    if (updated[t] || taken[s]) continue;
    tracks_[t].update(sightings[s]);
    updated[t] = taken[s] = true;
  }
  return taken;
}

bool ObjectTracker::isUndecided(const Track& track, double stamp) const {
  return stamp - track.firstSeen() < options_.undecided_time - kRound;
}

}  // namespace parley

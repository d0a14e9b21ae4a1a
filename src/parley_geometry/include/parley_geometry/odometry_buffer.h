// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <optional>

#include "parley_geometry/motion.h"

namespace parley {

enum class OdometryVerdict { kAccepted, kNotFinite, kOutOfOrder, kTimeWentBack, kJumped };

/// The last seconds of a robot's odometry, with poses interpolated between readings.
class OdometryBuffer {
 public:
  /// Keeps `horizon` seconds, at most `capacity` readings. A reading further from the last than `jump_distance` [m] or
  /// `jump_angle` [rad] after less than a second is a jump: it is taken, and all before it is forgotten.
  explicit OdometryBuffer(double horizon = 2.0, std::size_t capacity = 2000, double jump_distance = 1.0, double jump_angle = 1.0);

  /// A stamp older than the newest by less than a second is out of order and dropped; by more, time went back: the
  /// buffer starts again from this reading.
  OdometryVerdict add(const Odometry& reading);

  bool empty() const { return readings_.empty(); }
  void clear() { readings_.clear(); }
  const Odometry& latest() const { return readings_.back(); }

  /// Interpolated reading; up to 0.1 s after the newest it is extrapolated by the twist. nullopt outside.
  std::optional<Odometry> at(double time) const;

 private:
  bool jumps(const Odometry& from, const Odometry& to) const;

  double horizon_;
  std::size_t capacity_;
  double jump_distance_;
  double jump_angle_;
  std::deque<Odometry> readings_;
};

}  // namespace parley

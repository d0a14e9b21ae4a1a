// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <random>

#include "parley_exchange/messages.h"
#include "parley_exchange/team_key.h"

namespace parley {

/// Content that passes the checks, different for each seed.
class RandomContent {
 public:
  explicit RandomContent(std::uint64_t seed) : engine_(seed) {}

  PacketContent packet();
  Beacon beacon();
  TrajectoryMessage trajectory();
  IntentMessage intent();
  Conflict conflict();
  std::vector<ObservationMessage> observations();
  DigestEntry digestEntry();
  RecordGroup group();
  Record record(std::uint32_t sequence);
  ContourBody contour();
  EdgeBody edge();
  Pose2 pose(double extent);

  double real(double low, double high);
  int whole(int low, int high);  // both included
  std::uint32_t word() { return static_cast<std::uint32_t>(engine_()); }
  bool chance(double probability) { return real(0.0, 1.0) < probability; }
  Bytes bytes(std::size_t count);

 private:
  std::mt19937_64 engine_;
};

}  // namespace parley

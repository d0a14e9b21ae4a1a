// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace parley {

/// A return of the scan, and whether it has come into sight only lately.
struct DatedReturn {
  Eigen::Vector2d point = Eigen::Vector2d::Zero();  // [m]
  double range = 0.0;                               // [m]
  bool fresh = false;
  bool young = false;  // it has been in sight for a short while, or is fresh
  int bin = 0;         // [-] of the scan
};

/// What may be a robot, or as much of one as can be seen.
struct FreshPiece {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();  // [m]
  double chord = 0.0;                                // [m]
};

/// Runs of young returns no longer than `longest` [m] that something nearer hides the rest of: what stands behind a corner may
/// be a robot that waits there. `returns` and `jump` as for freshPieces().
std::vector<FreshPiece> emergingPieces(const std::vector<DatedReturn>& returns, double longest, double jump);

/// Runs of fresh returns no longer than `longest` [m], but for those that go on straight where known ones end: these are the
/// rest of a wall. `returns` by bearing; ranges further apart than `jump` [m] belong to two things.
std::vector<FreshPiece> freshPieces(const std::vector<DatedReturn>& returns, double longest, double jump);

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "cost_spreader.h"
#include "fresh_pieces.h"
#include "parley_geometry/motion.h"
#include "reference_path.h"
#include "surroundings.h"

namespace parley {

struct SightLawOptions {
  double intruder_speed = 2.0;      // [m/s] of what nobody has seen
  double intruder_radius = 0.2;     // [m] of the smallest disc in one
  double intruder_clearance = 0.6;  // [m] of its middle from walls: it too keeps away from blind corners
  double reaction_time = 0.2;       // [s] from first sight to braking, either robot
  double contact_distance = 0.7;    // [m] between the middles of two robots that touch
  double least_speed = 0.4;         // [m/s] never slower: it would not help, and the robot must get on
  double look_ahead_time = 0.2;     // [s] until the next plan knows more
  double intruder_length = 1.2;     // [m] longer things in one piece are no robots
  double memory_time = 3.0;         // [s] for which a robot that got out of sight is looked for near walls too
  double half_length = 0.4;         // [m] of this robot
  double half_width = 0.2;          // [m]
  double proof_time = 0.25;         // [s] what stays in its place for so long after first sight is no robot on its way
};

/// How fast one may drive so that a robot that comes out of hidden space and obeys the same law can still be avoided by both
/// braking. Keeps a grid of where a robot could be that nobody sees: all that is hidden at first; then what is seen is taken
/// out, and what is left grows by the speed of robots wherever one fits.
class SightLaw {
 public:
  SightLaw(const SightLawOptions& options, const MotionLimits& limits);

  void reset();
  /// Whether all robots near are known to be where they say: then what is hidden may stand or walk, but no robot comes from
  /// there.
  void setTeamKnown(bool known) { team_known_ = known; }
  /// Takes in what the newest scan sees at `now` [s] from `pose`, and how far off on the way to each place the nearest
  /// possible intruder is.
  void observe(const Surroundings& surroundings, const ObstacleScan& scan, const Pose2& T_odom_scan,
               const std::vector<TrackedObject>& tracks, const Pose2& pose, double now);
  /// [m/s] for each point of a path on which the robot is at arc length `start_s` [m], driving at `speed` [m/s], which is
  /// negative backwards.
  std::vector<double> bounds(const ReferencePath& path, double start_s, double speed, bool backwards = false) const;
  /// [m/s] for a gap [m] between the middles of two robots driving at each other: both brake after the reaction time.
  double speedFor(double gap) const;
  /// Distance [m] that an intruder must at least drive to a place ahead, or behind for one that drives `backwards`; `kFarGap`
  /// where none comes near.
  double gapAt(const Eigen::Vector2d& p_odom, bool backwards = false) const;
  bool possibleAt(const Eigen::Vector2d& p_odom) const;

 private:
  /// Somebody who is not heard and walks: may turn round at any moment, and does not look out.
  struct Walker {
    Eigen::Vector2d position = Eigen::Vector2d::Zero();   // [m]
    Eigen::Vector2d direction = Eigen::Vector2d::Zero();  // [-]
    double speed = 0.0;                                   // [m/s]
    double radius = 0.0;                                  // [m]
    double walked = 0.0;                                  // [s] when it was last seen to move
  };
  void followWalkers(const std::vector<TrackedObject>& tracks, double now);
  /// [m/s] at which the robot can still stop at a place before any walker that turns to it gets there.
  double speedBesideWalkers(const Eigen::Vector2d& p_odom, bool backwards) const;

  using Mask = std::vector<std::uint8_t>;
  using Costs = std::vector<int>;
  /// A grid of the last window in the new one; `fresh` where it was outside.
  template <class Value>
  std::vector<Value> carriedOver(const std::vector<Value>& grid, const GridFrame& frame, Value fresh) const;
  /// Dates the cells with returns; forgets those that are seen through.
  void dateReturns(const ObstacleScan& scan, const Pose2& T_odom_scan, const Mask& visible, double now);
  /// Distance [m] to the nearest obstacle that has been there for a while: what has just come into sight may be a robot.
  std::vector<float> roomsOf(const Surroundings& surroundings, double now) const;
  /// Cells where a robot that keeps its distance from walls, or the middle where it cannot, would drive.
  Mask middleOfWays(const std::vector<float>& rooms) const;
  Mask visible(const ObstacleScan& scan, const Pose2& T_odom_scan) const;
  /// Where the middle of a robot may be as far as the newest scan goes: a robot whose disc covers a place that is seen
  /// through is not there.
  Mask hidden(const Mask& visible) const;
  /// Driving distance from the nearest source, in units of a tenth of a cell, through cells whose price is not zero.
  Costs spread(const Costs& sources, const Mask& prices, int most) const;
  /// How long ago what is at a place came into sight; very large where nothing is. [s]
  double ageOf(const Eigen::Vector2d& p_odom, double now) const;
  std::vector<DatedReturn> dated(const ObstacleScan& scan, const Pose2& T_odom_scan, double now) const;
  /// How far those that may be in `from` can have driven since the last time, where they are not seen now.
  Mask driven(const Mask& from, const Mask& prices, const Mask& unseen, double elapsed);
  /// Keeps track of where robots that have been seen may be, out of sight.
  void followLost(const std::vector<TrackedObject>& tracks, const Mask& prices, const Mask& unseen, double now);
  /// How far off what can be seen is from the places round it; empty if nothing seen may come.
  Costs seenFrom(const std::vector<TrackedObject>& tracks, const std::vector<DatedReturn>& returns, double now) const;
  /// Something seen at `there` may drive off from all round it: lowers `sources` within `reach` [m].
  void addIntruder(const Eigen::Vector2d& there, double reach, double grace, Costs& sources) const;
  /// How far off the nearest possible intruder is on the way to each place; worked out when first asked for.
  const Costs& gaps(bool backwards) const;
  /// The same for one that drives forwards (1) or backwards (-1): nothing comes through it from behind.
  Costs gapsAhead(double direction) const;

  std::map<int, Walker> walkers_;  // by track
  bool team_known_ = false;
  SightLawOptions options_;
  MotionLimits limits_;
  GridFrame frame_;
  Mask lost_;                  // the same for robots that have been seen before they got out of sight
  double lost_until_ = -1e9;   // [s] when nobody asks any more where they are
  Mask possible_;              // cells where the middle of an unseen robot may be
  std::vector<double> dates_;  // [s] of the first return in a cell since it was last seen through; kNever if there is none
  Pose2 pose_;                 // of the robot in odom, the last time
  Mask prices_;                // of ways, the last time
  Costs hidden_;               // 0 where somebody unseen may be
  Costs seen_;                 // how far off what is in sight is
  mutable Costs gaps_;         // of one that drives forwards; empty until asked for
  mutable Costs gaps_behind_;  // of one that drives backwards
  mutable CostSpreader spreader_;
  double updated_at_ = -1e9;  // [s]
};

constexpr double kFarGap = 5.0;  // [m]

}  // namespace parley

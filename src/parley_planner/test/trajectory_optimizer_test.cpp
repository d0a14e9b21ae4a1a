// SPDX-License-Identifier: BSD-3-Clause
// Equation 1 of the paper as a whole: trajectory_optimizer, drive_refinement.
#include "trajectory_optimizer.h"

#include <gtest/gtest.h>

#include <random>

#include "drive_refinement.h"
#include "scenes.h"
#include "trajectory_validator.h"

namespace parley {
namespace {

constexpr double kStep = 0.05;  // [s]

double uniform(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

/// A scene, and drives through it as the planner makes them, with and without the optimisation.
class RefinementTest : public testing::Test {
 protected:
  static PathStart entryOf(const TrajectoryPoint& start) { return {start.pose, start.twist.speed, start.twist.turn_rate}; }
  void see(const World& world) {
    map_ = seenMap(world);
    surroundings_ = Surroundings(map_, {}, {}, {});
  }
  DriveScene scene() const { return {surroundings_, tracks_, 1.5, 0.1, peers_, 0.08}; }
  DrivenPath initial(const Path& path, const TrajectoryPoint& start) const {
    SmoothingOptions smoothing;
    smoothing.push_distance = kPush;
    DrivenPath driven{smoothed(path, entryOf(start), surroundings_.obstacles(), smoothing), {}, {}};
    driven.drive = generator_.along(driven.path, start, false, scene(), kMargins, {});
    return driven;
  }
  std::optional<DrivenPath> refined(const DrivenPath& driven) const {
    if (driven.drive.drive.points.empty()) return std::nullopt;
    const DriveScene around = scene();
    const SampledTrajectory none;
    const TrajectoryPoint start = driven.drive.drive.points.front();
    return DriveRefinement(options_, robotFootprint(), robotLimits())
        .refined({driven.path.points(), start, none, around, kMargins, kPush, nullptr, surroundings_.obstacles()}, driven,
                 generator_);
  }
  static double durationOf(const DrivenPath& driven) { return SampledTrajectory(driven.drive.drive.points).duration(); }

  static constexpr double kPush = 0.6;
  static constexpr Margins kMargins{0.05, 0.04, 0.2};
  LocalMap map_ = seenMap(World(10, 10, false));
  Surroundings surroundings_{map_, {}, {}, {}};
  std::vector<TrackedObject> tracks_;
  std::vector<PeerMotion> peers_;
  OptimizerOptions options_ = optimizerOptions({});
  DriveGenerator generator_{robotFootprint(), robotLimits(), kStep};
};

TEST_F(RefinementTest, ObeysLimitsAndMarginsInRandomScenes) {
  std::mt19937 random(21);
  int drives = 0, better = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    see(randomBoxes(seed, 10.0, 6));
    const TrajectoryPoint start{
        3.0, {2.0, 5.0, uniform(random, -0.4, 0.4)}, {uniform(random, 0.0, 1.5), uniform(random, -0.4, 0.4)}};
    const FoundPath found = searchPath(surroundings_, start.pose.position(), {6.5, uniform(random, 2.0, 8.0)}, {}, {});
    if (found.points.size() < 2) continue;
    const DrivenPath before = initial(straightened(surroundings_, found.points, 0.7), start);
    const std::optional<DrivenPath> after = refined(before);
    drives += before.drive.end == DriveEnd::kPathEnd ? 1 : 0;
    if (!after) continue;
    ++better;
    const std::vector<TrajectoryPoint>& points = after->drive.drive.points;
    EXPECT_EQ(motionFlaw(points, robotLimits()), "") << "seed " << seed;
    TrajectoryValidator validator(robotFootprint(), robotLimits(), 1.5, 0.1);
    const ObstacleScan scan;
    validator.observe({map_, scan, {}, tracks_});
    EXPECT_EQ(validator.check(SampledTrajectory(points), start, {0.03, 0.02, 0.2}).flaw, Flaw::kNone) << "seed " << seed;
    EXPECT_GE(after->drive.advance, before.drive.advance - 0.05) << "seed " << seed;
    EXPECT_LE(durationOf(*after), durationOf(before) + 0.05) << "seed " << seed;
    EXPECT_TRUE(keepsDistance(after->path, before.path, surroundings_.obstacles(), kPush)) << "seed " << seed;
  }
  EXPECT_GT(drives, 20);
  EXPECT_GT(better, drives / 4);
}

TEST_F(RefinementTest, SameInputsSameBits) {
  see(randomBoxes(4, 10.0, 6));
  const DrivenPath before = initial({{2.0, 5.0}, {4.0, 5.5}, {6.5, 4.0}}, {0.0, {2.0, 5.0, 0.2}, {1.0, 0.1}});
  const auto curve = [&] {
    const DriveScene around = scene();
    return TrajectoryOptimizer(options_, robotFootprint(), robotLimits())
        .optimized({before.path, before.drive.drive.points, {}, {}, around, kMargins, surroundings_.obstacles(), kPush});
  };
  const std::optional<PiecewiseQuintic> a = curve(), b = curve();
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->duration(), b->duration());
  for (double t = 0.0; t < a->duration(); t += 0.01) EXPECT_EQ(a->at(t).position, b->at(t).position);
}

TEST_F(RefinementTest, TakesNoMoreTimeRoundACorner) {
  World world(10, 10, true);
  world.fill(1.0, 2.0, 6.0, 4.0, false);
  world.fill(4.0, 2.0, 6.0, 9.0, false);
  see(world);
  const DrivenPath before = initial({{2.0, 3.0}, {5.0, 3.0}, {5.0, 7.0}}, {0.0, {2.0, 3.0, 0.0}, {1.5, 0.0}});
  ASSERT_EQ(before.drive.end, DriveEnd::kPathEnd);
  const std::optional<DrivenPath> after = refined(before);
  ASSERT_TRUE(after);
  EXPECT_LE(durationOf(*after), durationOf(before));
  EXPECT_GT(after->drive.advance, before.drive.advance - 0.05);
}

TEST_F(RefinementTest, PassesATeammateThatDrives) {
  // One comes towards the robot, 0.45 m beside its line: the curve bends away from where the other will be.
  PeerMotion peer;
  peer.id = 2;
  peer.footprint = robotFootprint();
  std::vector<TrajectoryPoint> points;
  for (int i = 0; i <= 100; ++i) points.push_back({0.05 * i, {7.0 - 0.05 * i, 5.45, kPi}, {1.0, 0.0}});
  points.back().twist = {};
  peer.trajectory = SampledTrajectory(points);
  const TrajectoryPoint start{0.0, {2.0, 5.0, 0.0}, {1.0, 0.0}};
  const DrivenPath alone = initial({{2.0, 5.0}, {6.5, 5.0}}, start);
  peers_ = {peer};
  const DriveScene around = scene();
  const std::optional<PiecewiseQuintic> curve =
      TrajectoryOptimizer(options_, robotFootprint(), robotLimits())
          .optimized({alone.path, alone.drive.drive.points, {}, {}, around, kMargins, surroundings_.obstacles(), kPush});
  ASSERT_TRUE(curve);
  const auto leastApart = [&](const SampledTrajectory& trajectory) {
    double least = 1e3;
    for (const TrajectoryPoint& p : trajectory.points()) least = std::min(least, peerClearance(robotFootprint(), p, peer, 0.0));
    return least;
  };
  const double before = leastApart(SampledTrajectory(alone.drive.drive.points)),
               after = leastApart(curve->sampled(0.0, kStep, 0.0));
  EXPECT_LT(before, 0.06);
  EXPECT_GT(after, 0.08);
}

TEST_F(RefinementTest, StartsFromStandingAlongItsHeading) {
  const DrivenPath before = initial({{2.0, 5.0}, {4.0, 5.0}, {6.0, 6.5}}, {0.0, {2.0, 5.0, 0.3}, {}});
  const DriveScene around = scene();
  const std::optional<PiecewiseQuintic> curve =
      TrajectoryOptimizer(options_, robotFootprint(), robotLimits())
          .optimized({before.path, before.drive.drive.points, {}, {}, around, kMargins, surroundings_.obstacles(), kPush});
  ASSERT_TRUE(curve);
  const SampledTrajectory sampled = curve->sampled(0.0, 0.02, 0.3);
  EXPECT_NEAR(sampled.points()[1].pose.yaw, 0.3, 0.02);
  for (std::size_t i = 1; i < sampled.points().size(); ++i) {
    EXPECT_LT(std::abs(angleBetween(sampled.points()[i - 1].pose.yaw, sampled.points()[i].pose.yaw)), 0.2) << i;
  }
}

TEST_F(RefinementTest, RefusesWhatIsNoDrive) {
  const DriveScene around = scene();
  const TrajectoryOptimizer optimizer(options_, robotFootprint(), robotLimits());
  const ReferencePath reference(Path{{2.0, 5.0}, {2.05, 5.0}});
  const TrajectoryPoint start{0.0, {2.0, 5.0, 0.0}, {}};
  for (const std::vector<TrajectoryPoint>& drive :
       {std::vector<TrajectoryPoint>{}, {start}, {start, {0.05, start.pose, {}}}, {start, {9.0, start.pose, {}}}}) {
    EXPECT_FALSE(optimizer.optimized({reference, drive, {}, {}, around, kMargins, surroundings_.obstacles(), kPush}));
  }
  EXPECT_FALSE(refined(initial({{2.0, 5.0}, {2.4, 5.0}}, start))) << "too short to be worth it";
  DrivenPath infeasible = initial({{2.0, 5.0}, {6.0, 5.0}}, start);
  infeasible.drive.end = DriveEnd::kInfeasible;
  EXPECT_FALSE(refined(infeasible));
  options_.iterations = 0;
  EXPECT_FALSE(refined(initial({{2.0, 5.0}, {4.0, 5.0}, {6.0, 6.5}}, start)));
  // A path of two points, and a start on it that stands.
  options_.iterations = 12;
  const ReferencePath line(Path{{1.8, 5.0}, {6.0, 5.0}});
  DrivenPath straight{line, {}, generator_.along(line, start, false, around, kMargins, {})};
  ASSERT_EQ(straight.drive.end, DriveEnd::kPathEnd);
  const std::optional<DrivenPath> after = refined(straight);
  EXPECT_EQ(motionFlaw((after ? *after : straight).drive.drive.points, robotLimits()), "");
}

}  // namespace
}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

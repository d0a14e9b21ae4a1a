// SPDX-License-Identifier: BSD-3-Clause
#include "trajectory_validator.h"

#include <gtest/gtest.h>

#include <limits>

#include "scenes.h"

namespace parley {
namespace {

const Margins kMargins{0.03, 0.02, 0.2};

/// Straight ahead from (2, 5) with the limits' acceleration up to `top`, then braking.
std::vector<TrajectoryPoint> straight(double top) {
  std::vector<TrajectoryPoint> points = {{0.0, {2.0, 5.0, 0.0}, {}}};
  const auto go = [&points](double speed) {
    TrajectoryPoint p = points.back();
    p.pose.x += 0.5 * (p.twist.speed + speed) * 0.05;
    p.time += 0.05;
    p.twist.speed = speed;
    points.push_back(p);
  };
  while (points.back().twist.speed < top - 1e-9) go(points.back().twist.speed + 0.1);
  while (points.back().twist.speed > 1e-9) go(std::max(0.0, points.back().twist.speed - 0.1));
  return points;
}

class ValidatorTest : public testing::Test {
 protected:
  Flaw judge(std::vector<TrajectoryPoint> points) {
    const TrajectoryPoint begin{0.0, {2.0, 5.0, 0.0}, {}};
    return check(SampledTrajectory(std::move(points)), begin).flaw;
  }
  Verdict check(const SampledTrajectory& trajectory, const TrajectoryPoint& begin) {
    validator_.observe({map_, scan_, {}, tracks_});
    return validator_.check(trajectory, begin, kMargins);
  }
  LocalMap map_ = seenMap(World(10, 10, false));
  ObstacleScan scan_;
  std::vector<TrackedObject> tracks_;
  TrajectoryValidator validator_{robotFootprint(), robotLimits(), 1.5, 0.1};
};

TEST_F(ValidatorTest, PassesWhatIsRight) {
  EXPECT_EQ(judge(straight(2.0)), Flaw::kNone);
  EXPECT_EQ(judge({}), Flaw::kEmpty);
}

TEST_F(ValidatorTest, RefusesBadMotion) {
  auto points = straight(1.0);
  points[5].pose.y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(judge(points), Flaw::kNotFinite);
  points = straight(1.0);
  points.pop_back();
  EXPECT_EQ(judge(points), Flaw::kDoesNotStop);
  EXPECT_EQ(judge(straight(2.5)), Flaw::kLimits);
  points = straight(1.0);
  for (std::size_t i = 4; i < points.size(); ++i) points[i].pose.x += 0.1;
  EXPECT_EQ(judge(points), Flaw::kLimits);
  points = straight(1.0);
  points[3].twist.turn_rate = 0.5;
  EXPECT_EQ(judge(points), Flaw::kLimits);
  points = straight(1.0);
  for (TrajectoryPoint& p : points) p.pose.y += 0.05;
  EXPECT_EQ(judge(points), Flaw::kDiscontinuous);
}

TEST_F(ValidatorTest, FindsCellsReturnsAndTheUnseen) {
  const SampledTrajectory trajectory(straight(2.0));
  const double end = trajectory.points().back().pose.x;
  setCells(&map_, end + 0.45, 4.8, end + 0.55, 4.9, CellState::kOccupied);
  EXPECT_EQ(judge(straight(2.0)), Flaw::kNone);
  setCells(&map_, end + 0.3, 4.8, end + 0.4, 4.9, CellState::kOccupied);
  EXPECT_EQ(judge(straight(2.0)), Flaw::kObstacle);
  map_ = seenMap(World(10, 10, false));
  setCells(&map_, end - 0.2, 4.0, end + 1.0, 6.0, CellState::kUnknown);
  EXPECT_EQ(judge(straight(2.0)), Flaw::kUnseen);
}

TEST_F(ValidatorTest, BelievesTheNewestScan) {
  World world(10, 10, false);
  world.fill(3.9, 4.9, 4.1, 5.0, true);
  std::mt19937 random(1);
  const Pose2 pose{2.0, 5.0, 0.0};
  scan_ = castScan(world, pose, 0.0, 0.0, random);
  const TrajectoryPoint begin{0.0, pose, {}};
  validator_.observe({map_, scan_, pose, tracks_});
  EXPECT_EQ(validator_.check(SampledTrajectory(straight(2.0)), begin, kMargins).flaw, Flaw::kObstacle);
  // The same place as part of a moving thing that will be gone.
  TrackedObject track;
  track.position = {4.0, 4.95};
  track.velocity = {0.0, 2.0};
  track.radius = 0.15;
  track.moving = track.has_moved = true;
  tracks_ = {track};
  validator_.observe({map_, scan_, pose, tracks_});
  EXPECT_TRUE(validator_.check(SampledTrajectory(straight(2.0)), begin, kMargins).good());
  tracks_[0].velocity = {0.0, 0.0};
  EXPECT_EQ(validator_.check(SampledTrajectory(straight(2.0)), begin, kMargins).flaw, Flaw::kTrack);
  // Unknown cells that the scan sees through are free.
  tracks_.clear();
  scan_ = castScan(World(10, 10, false), pose, 0.0, 0.0, random);
  setCells(&map_, 3.0, 4.0, 5.0, 6.0, CellState::kUnknown);
  validator_.observe({map_, scan_, pose, tracks_});
  EXPECT_TRUE(validator_.check(SampledTrajectory(straight(2.0)), begin, kMargins).good());
}

TEST_F(ValidatorTest, StartingTooNearMayNotGetWorse) {
  setCells(&map_, 2.41, 4.9, 2.45, 5.1, CellState::kOccupied);
  EXPECT_EQ(judge(straight(0.2)), Flaw::kObstacle);
  std::vector<TrajectoryPoint> back = straight(0.2);
  for (TrajectoryPoint& p : back) {
    p.pose.x = 4.0 - p.pose.x;
    p.twist.speed = -p.twist.speed;
  }
  EXPECT_EQ(judge(back), Flaw::kNone);
}

TEST_F(ValidatorTest, JudgesTheRestOfACommittedOne) {
  const SampledTrajectory trajectory(straight(2.0));
  setCells(&map_, 2.9, 4.8, 3.0, 5.2, CellState::kOccupied);
  validator_.observe({map_, scan_, {}, tracks_});
  EXPECT_EQ(validator_.checkRest(trajectory, 0.3, kMargins).flaw, Flaw::kObstacle);
  EXPECT_TRUE(validator_.checkRest(trajectory, trajectory.endTime(), kMargins).good());
  EXPECT_EQ(validator_.checkRest({}, 0.0, kMargins).flaw, Flaw::kEmpty);
}

}  // namespace
}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

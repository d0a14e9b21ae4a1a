// SPDX-License-Identifier: BSD-3-Clause
#include "object_tracker.h"

#include <gtest/gtest.h>

#include "world.h"

namespace parley::test {
namespace {

Sighting at(double x, double y, double stamp) { return {stamp, {x, y}, 0.2, {{x, y}}}; }

/// Open space, seen all around.
void addScan(ScanHistory& history, double stamp) {
  BinnedScan scan(720);
  scan.range_max = 10.0;
  for (int bin = 0; bin < 720; ++bin) scan.addFree(bin);
  history.add(scan, stamp, {});
}

class ObjectTrackerTest : public testing::Test {
 protected:
  void see(double stamp, const std::vector<Sighting>& sightings) {
    addScan(history_, stamp);
    tracker_.update(sightings, history_, Eigen::Vector2d::Zero());
  }

  LidarOptions options_;
  ScanHistory history_{1.0};
  ObjectTracker tracker_{options_};
};

TEST_F(ObjectTrackerTest, FollowsConstantVelocity) {
  std::mt19937 random(21);
  std::normal_distribution<double> noise(0.0, 0.03);
  for (int i = 0; i <= 30; ++i) {
    const double t = 0.1 * i;
    see(t, {at(1.0 + 1.5 * t + noise(random), 2.0 - 0.5 * t + noise(random), t)});
    ASSERT_EQ(tracker_.tracks().size(), 1U);
    if (i < 10) continue;
    const TrackedObject& object = tracker_.tracks()[0].object();
    EXPECT_NEAR((object.velocity - Eigen::Vector2d(1.5, -0.5)).norm(), 0.0, 0.35) << t;
    EXPECT_NEAR((object.position - Eigen::Vector2d(1.0 + 1.5 * t, 2.0 - 0.5 * t)).norm(), 0.0, 0.1) << t;
  }
  EXPECT_EQ(tracker_.tracks()[0].object().observations, 31);
  EXPECT_EQ(tracker_.tracks()[0].object().id, 1);
}

TEST_F(ObjectTrackerTest, TwoThatPassKeepTheirIdentity) {
  for (int i = 0; i <= 20; ++i) {
    const double t = 0.1 * i;
    see(t, {at(-1.0 + t, 2.0, t), at(1.0 - t, 2.5, t)});
    ASSERT_EQ(tracker_.tracks().size(), 2U);
  }
  for (const Track& track : tracker_.tracks()) {
    const bool rightward = track.object().velocity.x() > 0.0;
    EXPECT_NEAR(track.object().position.y(), rightward ? 2.0 : 2.5, 0.05);
  }
}

TEST_F(ObjectTrackerTest, SurvivesAShortGapAndIsForgottenAfterALongOne) {
  for (int i = 0; i < 10; ++i) see(0.1 * i, {at(0.1 * i, 2.0, 0.1 * i)});
  for (int i = 10; i < 15; ++i) see(0.1 * i, {});
  see(1.5, {at(1.5, 2.0, 1.5)});
  ASSERT_EQ(tracker_.tracks().size(), 1U);
  EXPECT_EQ(tracker_.tracks()[0].object().id, 1);
  for (int i = 16; i < 23; ++i) see(0.1 * i, {});
  EXPECT_TRUE(tracker_.tracks().empty());
  see(2.4, {at(2.4, 2.0, 2.4)});
  EXPECT_EQ(tracker_.tracks()[0].object().id, 2) << "identifiers are not used twice";
}

TEST_F(ObjectTrackerTest, WhenFullTheNearestAreFollowed) {
  std::vector<Sighting> many;
  for (int i = 0; i < 100; ++i) many.push_back(at(100.0 - i, 0.0, 0.0));
  see(0.0, many);
  ASSERT_EQ(tracker_.tracks().size(), 64U);
  for (const Track& track : tracker_.tracks()) EXPECT_LE(track.object().position.x(), 64.0);
}

TEST_F(ObjectTrackerTest, MovesOnceDisplacedAndSeenThroughAndSettlesAfterItStopped) {
  double stopped = 0.0;
  for (int i = 0; i <= 60; ++i) {
    const double t = 0.1 * i, x = std::min(t, 1.0);
    Sighting sighting = at(x, 2.0, t);
    for (double dx = -0.1; dx <= 0.1; dx += 0.04) sighting.points.push_back({x + dx, 2.0});
    see(t, {sighting});
    const bool moving = tracker_.tracks()[0].object().moving;
    EXPECT_FALSE(moving && i < 2);
    EXPECT_TRUE(moving || i < 4 || i > 35) << t;
    if (!moving && stopped == 0.0 && i > 10) stopped = t;
  }
  EXPECT_TRUE(tracker_.tracks()[0].object().has_moved) << "that is remembered";
  EXPECT_GT(stopped, 1.0 + options_.moving_hold - 0.2);
  EXPECT_LT(stopped, 1.0 + options_.moving_hold + options_.moving_window + 0.2);
}

TEST_F(ObjectTrackerTest, UndecidedWhileNew) {
  for (int i = 0; i <= 6; ++i) {
    see(0.1 * i, {at(1.0, 1.0, 0.1 * i)});
    EXPECT_EQ(tracker_.isUndecided(tracker_.tracks()[0], 0.1 * i), i < 4);
  }
}

TEST(SightingOf, KeepsFewPointsEvenly) {
  BlobShape shape;
  for (int i = 0; i < 1000; ++i) shape.points.push_back({1.0, 0.001 * i});
  const Sighting sighting = sightingOf(shape, {1.0, 0.0, 0.0}, 3.0, 48);
  EXPECT_LE(sighting.points.size(), 48U);
  EXPECT_GE(sighting.points.size(), 40U);
  EXPECT_GT(sighting.points.back().y(), 0.95);
  EXPECT_EQ(sighting.points.front().x(), 2.0);
}

TEST(ScanHistory, IsBoundedInTimeAndNumber) {
  ScanHistory history(0.5);
  for (int i = 0; i < 20; ++i) addScan(history, 0.1 * i);
  EXPECT_EQ(history.scans().size(), 6U);
  for (int i = 0; i < 1000; ++i) addScan(history, 2.0 + 1e-4 * i);
  EXPECT_LE(history.scans().size(), 40U);
}

TEST(ScanHistory, ViewIsTheLeastAroundAndNothingWhereNotLooked) {
  BinnedScan scan(720);
  scan.range_max = 10.0;
  for (int bin = 0; bin < 700; ++bin) scan.addFree(bin);
  scan.addHit(362, 3.0F, 362);
  ScanHistory history(1.0);
  history.add(scan, 0.0, {1.0, 1.0, 0.5 * kPi});
  const PastScan& past = history.scans().back();
  EXPECT_EQ(past.viewToward({1.0, 3.0}, 0.001), 10.0);
  EXPECT_EQ(past.viewToward({1.0, 3.0}, 0.05), 3.0);
  EXPECT_EQ(past.viewToward({1.0, -3.0}, 0.01), 0.0) << "not looked at";
  EXPECT_NEAR(past.distanceTo({1.0, 3.0}), 2.0, 1e-12);
  EXPECT_TRUE(past.hasReturnNear({1.0, 4.0}, 0.2));
  EXPECT_FALSE(past.hasReturnNear({1.0, 3.5}, 0.2));
}

}  // namespace
}  // namespace parley::test

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

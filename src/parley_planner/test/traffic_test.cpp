// SPDX-License-Identifier: BSD-3-Clause
#include "traffic.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "scenes.h"

namespace parley {
namespace {

class TrafficTest : public testing::Test {
 protected:
  TrafficTest() {
    scan_.ranges.assign(720, std::numeric_limits<float>::infinity());
    scan_.transient.assign(720, false);
    scan_.range_max = 4.0;
  }

  static PeerMotion peer(std::uint32_t id, const Pose2& pose, const Eigen::Vector2d& to, double priority = 1.0) {
    PeerMotion motion;
    motion.id = id;
    motion.footprint = robotFootprint();
    motion.trajectory = SampledTrajectory::standing(pose, 0.0);
    motion.intent = {{priority, id, 0}, {pose.position(), to}};
    return motion;
  }

  void observe(Traffic* traffic, std::vector<PeerMotion> peers, double now = 0.0) {
    PlanRequest request{now, now, {now, {}, {}, 0, 0}, map_, scan_, {}, tracks_, route_, {9, 5}, 0.3, committed_};
    request.peers = std::move(peers);
    traffic->observe(request);
  }

  static Path way(double x1, double y1, double x2, double y2) { return resampled({{x1, y1}, {x2, y2}}, kTubeStep); }

  /// On its way, with its heading along it.
  static TrafficDecision decide(Traffic* traffic, const Path& way, const RightOfWay& own, double speed, double now) {
    const Eigen::Vector2d step = way.back() - way.front();
    return traffic->decide(way, own, {now, {way.front().x(), way.front().y(), std::atan2(step.y(), step.x())}, {speed, 0.0}},
                           now);
  }

  PlannerOptions options_;
  LocalMap map_ = seenMap(World(10, 10, false));
  ObstacleScan scan_;
  std::vector<TrackedObject> tracks_;
  Route route_;
  SampledTrajectory committed_;
  Traffic traffic_{options_, robotFootprint()};
};

TEST(RightOfWay, OrdersAnyTwo) {
  EXPECT_TRUE(goesBefore({10.0, 1, 0}, {1.0, 9, 0}));  // shut in
  EXPECT_TRUE(goesBefore({1.0, 9, 0}, {1.0, 8, 0}));
  EXPECT_TRUE(goesBefore({1.0, 9, 0}, {1.0, 9, 1}));  // who pushes goes before whom it pushes
  EXPECT_TRUE(goesBefore({1.0, 9, 3}, {1.0, 8, 0}));  // and lends its right
  std::mt19937 random(5);
  std::uniform_int_distribution<int> few(0, 2);
  const auto any = [&] { return RightOfWay{1.0 * few(random), static_cast<std::uint32_t>(few(random)), few(random)}; };
  for (int i = 0; i < 1000; ++i) {
    const RightOfWay a = any(), b = any(), c = any();
    EXPECT_FALSE(goesBefore(a, b) && goesBefore(b, a));
    const bool same = a.priority == b.priority && a.holder == b.holder && a.depth == b.depth;
    EXPECT_EQ(same, !goesBefore(a, b) && !goesBefore(b, a));
    EXPECT_TRUE(goesBefore(a, c) || !goesBefore(a, b) || !goesBefore(b, c));
  }
}

TEST_F(TrafficTest, OfTwoWhoseWaysMeetExactlyOneMakesRoom) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(1.0, 9.0);
  int met = 0;
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector2d a1(place(random), place(random)), a2(place(random), place(random));
    const Eigen::Vector2d b1(place(random), place(random)), b2(place(random), place(random));
    if ((a1 - b1).norm() < 1.0 || (a1 - a2).norm() < 1.0 || (b1 - b2).norm() < 1.0) continue;
    Traffic a(options_, robotFootprint()), b(options_, robotFootprint());
    observe(&a, {peer(2, {b1.x(), b1.y(), 0.0}, b2)});
    observe(&b, {peer(1, {a1.x(), a1.y(), 0.0}, a2)});
    const TrafficDecision of_a = decide(&a, way(a1.x(), a1.y(), a2.x(), a2.y()), {1.0, 1, 0}, 0.0, 0.0);
    const TrafficDecision of_b = decide(&b, way(b1.x(), b1.y(), b2.x(), b2.y()), {1.0, 2, 0}, 0.0, 0.0);
    EXPECT_TRUE(of_b.first.empty()) << "the second goes first";
    met += static_cast<int>(of_a.first.size());
  }
  EXPECT_GT(met, 50);
}

TEST_F(TrafficTest, WhoFollowsOrPassesEarlyDoesNotWait) {
  observe(&traffic_, {peer(9, {5.0, 5.0, 0.0}, {9.0, 5.0})});
  EXPECT_TRUE(decide(&traffic_, way(2.0, 5.0, 9.0, 5.0), {1.0, 1, 0}, 1.0, 0.0).first.empty());
  observe(&traffic_, {peer(9, {1.0, 8.0, 0.0}, {9.0, 8.0})});
  EXPECT_TRUE(decide(&traffic_, way(7.5, 7.0, 7.5, 9.5), {1.0, 1, 0}, 1.0, 0.0).first.empty());
  EXPECT_EQ(decide(&traffic_, way(3.0, 4.0, 3.0, 9.5), {1.0, 1, 0}, 1.0, 0.0).first.size(), 1U);
  // Who has arrived before goes in front of nobody.
  observe(&traffic_, {peer(9, {2.0, 5.0, 0.0}, {9.0, 5.0})});
  EXPECT_TRUE(decide(&traffic_, way(4.0, 5.0, 8.0, 5.0), {1.0, 1, 0}, 1.0, 0.0).first.empty());
  EXPECT_EQ(decide(&traffic_, way(4.0, 5.0, 8.0, 5.0), {0.0, 1, 0}, 1.0, 0.0).first.size(), 1U);
}

TEST_F(TrafficTest, WhoStandsAskewIsInTheWayOfWhomItsMiddleIsNot) {
  observe(&traffic_, {peer(9, {2.0, 5.0, 0.0}, {9.0, 5.0})});
  const TrajectoryPoint along{0.0, {5.0, 5.55, 0.0}, {}}, across{0.0, {5.0, 5.55, 1.57}, {}};
  EXPECT_FALSE(traffic_.decide({{5.0, 5.55}}, {1.0, 1, 0}, along, 0.0).in_the_way);
  EXPECT_TRUE(traffic_.decide({{5.0, 5.55}}, {1.0, 1, 0}, across, 0.0).in_the_way);
}

TEST_F(TrafficTest, WhoHasToLeaveLendsTheRightOfWhoPushes) {
  observe(&traffic_, {peer(9, {2.0, 5.0, 0.0}, {9.0, 5.0}), peer(5, {6.0, 5.0, 0.0}, {6.0, 5.0})});
  const TrafficDecision decision = decide(&traffic_, {{4.0, 5.0}}, {1.0, 1, 0}, 0.0, 0.0);
  EXPECT_TRUE(decision.in_the_way);
  EXPECT_EQ(decision.right.holder, 9U);
  EXPECT_EQ(decision.right.depth, 1);
  // For a while after it was needed, no longer.
  observe(&traffic_, {}, 0.3);
  EXPECT_EQ(decide(&traffic_, {{4.0, 5.0}}, {1.0, 1, 0}, 0.0, 0.3).right.holder, 9U);
  EXPECT_EQ(decide(&traffic_, {{4.0, 5.0}}, {1.0, 1, 0}, 0.0, 1.0).right.holder, 1U);
}

TEST_F(TrafficTest, WithNowhereToGoARobotGoesFirstAfterAWhileUntilItIsOut) {
  const Eigen::Vector2d here(3.0, 3.0);
  EXPECT_FALSE(traffic_.cannotMakeRoom(0.0, here));
  EXPECT_FALSE(traffic_.cannotMakeRoom(0.4, here));
  EXPECT_FALSE(traffic_.isShutIn(0.5));
  EXPECT_FALSE(traffic_.cannotMakeRoom(0.8, here));
  EXPECT_TRUE(traffic_.cannotMakeRoom(1.1, here));
  EXPECT_TRUE(traffic_.isShutIn(5.0));
  EXPECT_FALSE(traffic_.isShutIn(60.0));
  traffic_.isOutAgain();
  EXPECT_FALSE(traffic_.isShutIn(5.0));
}

TEST_F(TrafficTest, InANarrowPlaceTheRightOfWhoWasShutInLastsWhileItGetsOn) {
  for (const double t : {0.0, 0.4, 0.8, 1.1}) traffic_.cannotMakeRoom(t, {3.0, 3.0});
  traffic_.getsOn(15.0, {6.0, 3.0}, true);  // room, but not far enough
  traffic_.getsOn(30.0, {15.0, 3.0}, false);
  EXPECT_TRUE(traffic_.isShutIn(45.0));
  traffic_.getsOn(48.0, {15.3, 3.0}, false);  // hardly further
  EXPECT_FALSE(traffic_.isShutIn(50.5));
  traffic_.getsOn(49.0, {17.0, 3.0}, true);
  EXPECT_FALSE(traffic_.isShutIn(49.0));
}

TEST_F(TrafficTest, WhoFollowsOneThatIsStuckGivesItRoomToTurn) {
  const std::vector<PeerMotion> ahead = {peer(9, {3.7, 5.0, kPi}, {8.0, 5.0})};  // 0.7 m ahead, looks the other way
  const Path wish = way(3.0, 5.0, 8.0, 5.0);
  observe(&traffic_, ahead, 0.0);
  EXPECT_FALSE(decide(&traffic_, wish, {1.0, 5, 0}, 0.0, 0.0).in_the_way);
  std::vector<PeerMotion> later = ahead;
  later[0].heard = 2.5;
  observe(&traffic_, later, 2.5);
  EXPECT_TRUE(decide(&traffic_, wish, {1.0, 5, 0}, 0.0, 2.5).in_the_way);
}

TEST_F(TrafficTest, ARightOfWayThatGoesRoundInCirclesDiesOut) {
  PeerMotion pushing = peer(9, {4.0, 5.0, kPi}, {1.0, 5.0});
  pushing.intent.right = {10.0, 7, 14};
  observe(&traffic_, {pushing});
  EXPECT_EQ(decide(&traffic_, way(3.0, 5.0, 8.0, 5.0), {1.0, 5, 0}, 0.0, 0.0).right.depth, 15);
  pushing.intent.right.depth = 15;
  traffic_.reset();
  observe(&traffic_, {pushing});
  EXPECT_EQ(decide(&traffic_, way(3.0, 5.0, 8.0, 5.0), {1.0, 5, 0}, 0.0, 0.0).right.depth, 0);
  // Nor does a robot make room for one that it pushes itself.
  pushing.intent.right = {10.0, 5, 1};
  traffic_.reset();
  observe(&traffic_, {pushing});
  EXPECT_TRUE(decide(&traffic_, way(3.0, 5.0, 8.0, 5.0), {1.0, 5, 0}, 0.0, 0.0).first.empty());
}

TEST_F(TrafficTest, WhatIsLentCountsWhatItsHolderSays) {
  PeerMotion between = peer(7, {4.0, 5.0, kPi}, {1.0, 5.0});
  between.intent.right = {10.0, 9, 2};
  PeerMotion holder = peer(9, {6.0, 5.0, kPi}, {1.0, 5.0});
  const auto priority = [&](const std::vector<PeerMotion>& peers) {
    observe(&traffic_, peers);
    return traffic_.tubes().front().right.priority;
  };
  EXPECT_EQ(priority({between}), 10.0) << "nobody says otherwise";
  EXPECT_EQ(priority({between, holder}), 1.0) << "it is not shut in any longer";
  holder.intent.right.priority = 10.0;
  EXPECT_EQ(priority({between, holder}), 10.0);
  holder.intent.right = {1.5, 4, 1};
  EXPECT_EQ(priority({between, holder}), 10.0) << "it says nothing of its own";
}

TEST_F(TrafficTest, WhatThePeerCoversIsNoObstacleUnlessItIsElsewhere) {
  scan_.ranges[360] = 1.6F;  // ahead: the near end of a peer 2 m off
  TrackedObject track;
  track.position = {1.7, 0.0};
  track.radius = 0.2;
  track.observations = 10;
  track.moving = track.has_moved = true;
  tracks_ = {track};
  observe(&traffic_, {peer(9, {2.0, 0.0, 0.0}, {5.0, 0.0})});
  EXPECT_TRUE(std::isnan(traffic_.scan().ranges[360]));
  EXPECT_TRUE(traffic_.tracks().empty());
  ASSERT_EQ(traffic_.peers().size(), 1U);
  // The lidar follows something there, but not where the peer says that it is.
  tracks_[0].position = {2.0, 0.7};
  observe(&traffic_, {peer(9, {2.0, 0.0, 0.0}, {5.0, 0.0})});
  EXPECT_TRUE(traffic_.peers().empty());
  EXPECT_EQ(traffic_.tracks().size(), 1U);
  // Nor is one believed that has been silent for long.
  tracks_.clear();
  observe(&traffic_, {peer(9, {2.0, 0.0, 0.0}, {5.0, 0.0})}, 10.0);
  EXPECT_TRUE(traffic_.peers().empty());
}

TEST_F(TrafficTest, WhoComesTowardsCountsAsMovingThing) {
  observe(&traffic_, {peer(9, {6.0, 5.0, kPi}, {2.0, 5.0}), peer(8, {6.0, 8.0, kPi}, {2.0, 8.0})});
  const auto oncoming = traffic_.oncoming(way(1.0, 5.0, 8.0, 5.0), 0.0);
  ASSERT_EQ(oncoming.size(), 1U);
  EXPECT_NEAR(oncoming[0].position.x(), 6.0, 1e-9);
}

TEST_F(TrafficTest, WhoMeansToTurnBackStillComesUntilItHasStopped) {
  PeerMotion braking = peer(9, {6.0, 5.0, kPi}, {9.0, 5.0});  // it has told that it makes room
  const Path wish = way(1.0, 5.0, 8.0, 5.0);
  observe(&traffic_, {braking});
  EXPECT_TRUE(traffic_.oncoming(wish, 0.0).empty());
  std::vector<TrajectoryPoint> points;
  for (int k = 0; k <= 10; ++k) {
    const double t = 0.1 * k;
    points.push_back({t, {6.0 - t + 0.5 * t * t, 5.0, kPi}, {1.0 - t, 0.0}});
  }
  braking.trajectory = SampledTrajectory(points);
  observe(&traffic_, {braking});
  ASSERT_EQ(traffic_.oncoming(wish, 0.0).size(), 1U);
  EXPECT_NEAR(traffic_.oncoming(wish, 0.0)[0].velocity.x(), -1.0, 1e-9);
  observe(&traffic_, {braking}, 1.1);
  EXPECT_TRUE(traffic_.oncoming(wish, 1.1).empty()) << "it stands";
}

}  // namespace
}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

// SPDX-License-Identifier: BSD-3-Clause
#include "peer_tube.h"

#include <gtest/gtest.h>

#include "parley_geometry/polygon.h"
#include "scenes.h"

namespace parley {
namespace {

PeerMotion peerAt(const Pose2& pose, std::vector<Eigen::Vector2d> way) {
  PeerMotion peer;
  peer.id = 7;
  peer.footprint = robotFootprint();
  peer.trajectory = SampledTrajectory::standing(pose, 0.0);
  peer.intent = {{1.0, 7, 0}, std::move(way)};
  return peer;
}

Path straight(double x1, double y1, double x2, double y2) { return resampled({{x1, y1}, {x2, y2}}, kTubeStep); }

TEST(PeerTube, FollowsTheWayFromWhereThePeerIsByNow) {
  const PeerTube tube = tubeOf(peerAt({3.0, 5.1, 0.0}, {{1.0, 5.0}, {6.0, 5.0}, {6.0, 9.0}}), 1.0, 0.1);
  EXPECT_TRUE(tube.standing);
  EXPECT_NEAR((tube.way.front() - Eigen::Vector2d(3.0, 5.1)).norm(), 0.0, 1e-9);
  EXPECT_NEAR((tube.way.back() - Eigen::Vector2d(6.0, 9.0)).norm(), 0.0, 1e-9);
  EXPECT_NEAR(pathLength(tube.way), 7.0, 0.05);
  for (std::size_t i = 1; i < tube.way.size(); ++i) EXPECT_LT((tube.way[i] - tube.way[i - 1]).norm(), kTubeStep + 1e-9);
}

TEST(PeerTube, IsOfTheTrajectoryWhereNothingElseIsKnownOrFits) {
  PeerMotion peer = peerAt({2.0, 5.0, 0.0}, {});
  std::vector<TrajectoryPoint> points;
  for (int i = 0; i <= 20; ++i) points.push_back({0.1 * i, {2.0 + 0.1 * i, 5.0, 0.0}, {i < 20 ? 1.0 : 0.0, 0.0}});
  peer.trajectory = SampledTrajectory(points);
  const PeerTube tube = tubeOf(peer, 1.0, 0.1);
  EXPECT_FALSE(tube.standing);
  EXPECT_NEAR(tube.speed, 1.0, 1e-9);
  EXPECT_NEAR(tube.way.front().x(), 3.0, 1e-9);
  EXPECT_NEAR(tube.way.back().x(), 4.0, 1e-9);
  peer.intent.way = {{2.0, 8.0}, {9.0, 8.0}};  // of some time ago
  EXPECT_NEAR(tubeOf(peer, 1.0, 0.1).way.back().y(), 5.0, 1e-9);
}

TEST(PeerTube, IsNoLongerThanAnybodyNeedsToKnow) {
  EXPECT_NEAR(pathLength(tubeOf(peerAt({0.0, 0.0, 0.0}, {{0.0, 0.0}, {50.0, 0.0}}), 0.0, 0.1).way), 8.0, 1e-6);
}

TEST(PeerTube, TellsHowTwoWaysMeet) {
  const PeerTube tube = tubeOf(peerAt({8.0, 5.0, kPi}, {{8.0, 5.0}, {2.0, 5.0}}), 0.0, 0.1);
  const auto head_on = meetingOf(straight(1.0, 5.0, 7.0, 5.0), tube, 0.5);
  ASSERT_TRUE(head_on);
  EXPECT_TRUE(head_on->head_on);
  EXPECT_TRUE(head_on->against);
  EXPECT_NEAR(head_on->enters, 0.6, 0.15);
  const auto crossing = meetingOf(straight(5.0, 1.0, 5.0, 9.0), tube, 0.5);
  ASSERT_TRUE(crossing);
  EXPECT_TRUE(crossing->against);
  EXPECT_FALSE(crossing->head_on);
  EXPECT_NEAR(crossing->enters, 3.5, 0.1);
  EXPECT_NEAR(crossing->leaves, 4.5, 0.1);
  EXPECT_NEAR(crossing->peer_enters, 3.0, 0.2);
  const auto behind = meetingOf(straight(9.5, 5.0, 3.0, 5.0), tube, 0.5);
  ASSERT_TRUE(behind);
  EXPECT_FALSE(behind->against);
  EXPECT_FALSE(meetingOf(straight(1.0, 7.0, 9.0, 7.0), tube, 0.5));
}

TEST(PeerTube, KeepsRightAsFarAsIsNeededAndThereIsRoom) {
  World world(10, 10, true);
  world.fill(0.0, 4.0, 10.0, 6.0, false);
  const Surroundings surroundings(seenMap(world), {}, {}, {});
  const PeerTube tube = tubeOf(peerAt({8.0, 5.0, kPi}, {{8.0, 5.0}, {2.0, 5.0}}), 0.0, 0.1);
  const Path against = straight(1.0, 5.0, 9.0, 5.0);
  // It drives to the left: its right is up. Half of the separation that is missing is its part.
  for (const Eigen::Vector2d& p : keepingRight(tube, against, 0.6, surroundings.obstacles())) EXPECT_NEAR(p.y(), 5.3, 0.06);
  for (const Eigen::Vector2d& p : keepingRight(tube, against, 3.0, surroundings.obstacles())) EXPECT_NEAR(p.y(), 5.7, 0.06);
  const Path aside = straight(1.0, 4.4, 9.0, 4.4);
  for (const Eigen::Vector2d& p : keepingRight(tube, aside, 0.6, surroundings.obstacles())) EXPECT_NEAR(p.y(), 5.0, 1e-9);
}

TEST(PeerTube, WaysBeginWhereTheRobotIs) {
  EXPECT_EQ(wayFrom({}, {1.0, 2.0}, 5.0).size(), 1U);
  const Path way = wayFrom({{0.0, 0.0}, {4.0, 0.0}, {4.0, 4.0}}, {2.0, 0.5}, 3.0);
  EXPECT_NEAR(way.front().y(), 0.5, 1e-9);
  EXPECT_NEAR(pathLength(way), 3.0, 0.05);
}

}  // namespace
}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

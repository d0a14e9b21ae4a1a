// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "team.h"

namespace parley {
namespace {

class Sharing : public testing::Test {
 protected:
  void start(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      team.add(3.0 * static_cast<double>(i));
      stand(i, {});
    }
  }
  void stand(std::size_t i, const Pose2& pose) { team[i].setOdometry(standing(pose, team.timeOf(i)), DriveState::kStopped); }
  void publish(std::size_t i, const std::vector<OwnContour>& contours) { team[i].publishContours(contours, team.timeOf(i)); }
  std::vector<SharedContour> held(std::size_t by, std::size_t of) { return team[by].contoursOf(team[of].id()); }
  void confirm(std::size_t by, std::size_t whom, const Pose2& pose) {
    PeerPose estimate;
    estimate.T_odom_peer.pose = pose;
    estimate.T_odom_peer.covariance = Eigen::Vector3d(1e-4, 1e-4, 1e-6).asDiagonal();
    estimate.state = EdgeState::kConfirmed;
    EXPECT_TRUE(team[by].setPeerPose(team[whom].id(), estimate, team.timeOf(by)));
  }

  Team team{3};
};

}  // namespace

TEST_F(Sharing, aContourArrivesInItsAnchorsFrame) {
  start(2);
  team.connectAll();
  stand(0, {10.0, 5.0, 0.0});
  publish(0, {wall(1, 11.0, 6.0, 3.0), {2, {{9.0, 4.0}, {9.5, 4.0}, {9.5, 4.5}}, true, true, 0.0}});
  team.run(2.0);
  const auto anchors = team[1].anchorsOf(team[0].id());
  const auto contours = held(1, 0);
  ASSERT_EQ(contours.size(), 2U);
  ASSERT_EQ(anchors.size(), 2U);
  const auto anchor =
      std::find_if(anchors.begin(), anchors.end(), [&](const SharedAnchor& a) { return a.id == contours[0].anchor; });
  const Polygon placed = transformed(anchor->pose, contours[0].polygon);
  EXPECT_LT((placed.front() - Eigen::Vector2d(11.0, 6.0)).norm(), 0.04);
  EXPECT_LT((placed.back() - Eigen::Vector2d(14.0, 6.0)).norm(), 0.04);
  EXPECT_TRUE(contours[1].closed);
  EXPECT_TRUE(contours[1].hole);
  EXPECT_EQ(contours[0].hops, 1);
  EXPECT_NEAR(contours[0].written, team.timeOf(1) - 2.0, 0.3);
}

TEST_F(Sharing, goesFromAToCThroughB) {
  start(3);
  team.connect(0, 1);
  team.connect(1, 2);
  publish(0, {wall(1, 1.0, 1.0, 3.0), wall(2, 1.0, 2.0, 3.0)});
  publish(2, {wall(1, 5.0, 1.0, 3.0)});
  team.run(8.0);
  EXPECT_EQ(held(2, 0).size(), 2U);
  EXPECT_EQ(held(0, 2).size(), 1U);
  EXPECT_EQ(held(2, 0).front().hops, 2);
  EXPECT_EQ(team[2].anchorsOf(team[0].id()).size(), 1U);
  EXPECT_TRUE(team[2].peers(team.timeOf(2)).size() == 1U) << "it has never heard robot_0 itself";
}

TEST_F(Sharing, whoHasAllIsSentNothing) {
  start(4);
  team.connectAll();
  team.loss = 0.5;
  for (std::size_t i = 0; i < 4; ++i) publish(i, {wall(1, 1.0, 1.0, 3.0), wall(2, 1.0, 2.0, 3.0)});
  const auto stay = [&](std::size_t i) { stand(i, {}); };
  team.run(30.0, stay);
  std::vector<std::int64_t> before;
  for (std::size_t i = 0; i < 4; ++i) before.push_back(team.recordBytes(i));
  team.run(20.0, stay);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(team.recordBytes(i), before[i]) << i;
  // Who comes back after a while and still has all costs nothing either.
  team.members[3].on = false;
  team.run(80.0, stay);
  team.members[3].on = true;
  team.loss = 0.0;
  team.run(20.0, stay);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(team.recordBytes(i), before[i]) << i;
}

TEST_F(Sharing, aContourThatStaysIsNotSentAgain) {
  start(2);
  team.connectAll();
  team.run(5.0, [&](std::size_t i) {
    stand(i, {});
    // Noise below the tolerance.
    publish(i, {wall(1, 1.0 + 0.03 * std::sin(50.0 * team.now), 1.0, 3.0)});
  });
  EXPECT_EQ(held(1, 0).front().name.sequence, 2U) << "an anchor and one version of a contour";
}

TEST_F(Sharing, aContourThatChangesReplacesTheOldOne) {
  start(2);
  team.connectAll();
  publish(0, {wall(1, 1.0, 1.0, 3.0)});
  team.run(4.0);
  publish(0, {wall(1, 1.0, 1.0, 5.0)});
  team.run(2.0);
  ASSERT_EQ(held(1, 0).size(), 1U);
  EXPECT_NEAR(pathLength(held(1, 0).front().polygon), 5.0, 0.1);
}

TEST_F(Sharing, aContourIsToldWhenItHasSettled) {
  team.options.contour_settle = 1.5;
  start(2);
  team.connectAll();
  for (int i = 0; i < 5; ++i) {  // the robot drives past a wall
    publish(0, {wall(1, 0.0, 1.0, 1.0 + 0.5 * i)});
    team.run(1.0);
  }
  EXPECT_TRUE(held(1, 0).empty());
  for (int i = 0; i < 3; ++i) {
    publish(0, {wall(1, 0.0, 1.0, 3.0)});
    team.run(1.0);
  }
  ASSERT_EQ(held(1, 0).size(), 1U);
  EXPECT_LE(team[0].counters().sections_sent.map, 60) << "once, not once for each length";
}

TEST_F(Sharing, aContourThatNeverSettlesIsToldAllTheSame) {
  team.options.contour_settle = 1.5;
  start(2);
  team.connectAll();
  for (int i = 0; i < 10; ++i) {
    publish(0, {wall(1, 0.0, 1.0, 1.0 + 0.5 * i)});
    team.run(1.0);
  }
  EXPECT_EQ(held(1, 0).size(), 1U);
}

TEST_F(Sharing, singleHitsAreNotTold) {
  start(2);
  team.connectAll();
  publish(0, {wall(1, 0.0, 1.0, 0.05), wall(2, 2.0, 1.0, 0.3)});
  team.run(2.0);
  EXPECT_EQ(held(1, 0).size(), 1U);
  publish(0, {wall(1, 0.0, 1.0, 0.05), wall(2, 2.0, 1.0, 0.1)});  // what shrinks to one is withdrawn
  team.run(3.0);
  publish(0, {wall(1, 0.0, 1.0, 0.05), wall(2, 2.0, 1.0, 0.1)});
  team.run(2.0);
  EXPECT_TRUE(held(1, 0).empty());
}

TEST_F(Sharing, aContourThatIsGoneIsWithdrawnEverywhere) {
  start(3);
  team.connect(0, 1);
  team.connect(1, 2);
  publish(0, {wall(1, 1.0, 1.0, 3.0), wall(2, 1.0, 2.0, 3.0)});
  team.run(8.0);
  ASSERT_EQ(held(2, 0).size(), 2U);
  team.run(8.0, [&](std::size_t i) {
    if (i == 0) publish(0, {wall(2, 1.0, 2.0, 3.0)});
  });
  EXPECT_EQ(held(0, 0).size(), 1U);
  EXPECT_EQ(held(1, 0).size(), 1U);
  EXPECT_EQ(held(2, 0).size(), 1U);
}

TEST_F(Sharing, aLateCopyBringsNoContourBack) {
  // Robot 2 has the contour, is away while it is withdrawn, and comes back with its copy.
  start(3);
  team.connectAll();
  publish(0, {wall(1, 1.0, 1.0, 3.0)});
  team.run(6.0);
  team.members[2].on = false;
  team.run(4.0, [&](std::size_t i) {
    if (i == 0) publish(0, {});
  });
  EXPECT_TRUE(held(1, 0).empty());
  team.members[0].on = false;
  team.members[2].on = true;
  ASSERT_EQ(held(2, 0).size(), 1U);
  team.run(10.0);
  EXPECT_TRUE(held(1, 0).empty());
  EXPECT_TRUE(held(2, 0).empty());
}

TEST_F(Sharing, aContestSwitchesOneVersionOffForAll) {
  start(3);
  team.connectAll();
  publish(0, {wall(7, 1.0, 1.0, 3.0, team.timeOf(0))});
  team.run(5.0);
  const ContourName name = held(1, 0).front().name;
  const int revision = team[2].mapRevision(team[0].id());
  EXPECT_TRUE(team[1].contest(name, team.timeOf(1)));
  EXPECT_TRUE(team[1].contest(name, team.timeOf(1))) << "once is enough";
  EXPECT_TRUE(held(1, 0).front().contested);
  team.run(5.0);
  EXPECT_TRUE(held(2, 0).front().contested);
  EXPECT_TRUE(held(0, 0).front().contested);
  EXPECT_GT(team[2].mapRevision(team[0].id()), revision);
  ASSERT_EQ(team.eventCount(0, ExchangeEventKind::kContourContested), 1);
  EXPECT_EQ(team.members[0].events.back().contour, 7);
  // The origin has not seen it since: it stays off. Then it sees it, and that wins.
  publish(0, {wall(7, 1.0, 1.0, 3.0, team.timeOf(0) - 20.0)});
  team.run(5.0);
  EXPECT_TRUE(held(2, 0).front().contested);
  publish(0, {wall(7, 1.0, 1.0, 3.0, team.timeOf(0))});
  publish(0, {wall(7, 1.0, 1.0, 3.0, team.timeOf(0))});
  team.run(5.0);
  EXPECT_FALSE(held(2, 0).front().contested);
  EXPECT_GT(held(2, 0).front().name.sequence, name.sequence);
  EXPECT_FALSE(team[1].contest(name, team.timeOf(1))) << "that version is gone";
}

TEST_F(Sharing, whatAConfirmedPeerToldIsEndorsedAndNotSentAgain) {
  start(3);
  team.connectAll();
  team.run(1.0);
  publish(0, {wall(1, 1.0, 1.0, 3.0)});
  team.run(4.0);
  confirm(1, 0, {2.0, 0.0, 0.0});
  // Robot 1 sees the same wall, 2 m further on in its own frame, and one of its own.
  publish(1, {wall(4, 3.1, 1.05, 2.8), wall(5, 3.0, 3.0, 3.0)});
  team.run(4.0);
  EXPECT_EQ(held(1, 1).size(), 1U);
  EXPECT_EQ(held(2, 1).size(), 1U);
  ASSERT_EQ(held(2, 0).size(), 1U);
  EXPECT_EQ(held(2, 0).front().endorsements, 1);
  // The peer withdraws it: now it is this robot's to tell.
  for (int i = 0; i < 3; ++i) {
    team.run(3.0, [&](std::size_t robot) {
      if (robot == 0) publish(0, {});
      if (robot == 1) publish(1, {wall(4, 3.1, 1.05, 2.8), wall(5, 3.0, 3.0, 3.0)});
    });
  }
  EXPECT_EQ(held(1, 1).size(), 2U);
}

TEST_F(Sharing, anUnconfirmedPeersContoursStandForNothing) {
  start(2);
  team.connectAll();
  publish(0, {wall(1, 1.0, 1.0, 3.0)});
  team.run(4.0);
  PeerPose tentative;
  tentative.T_odom_peer.covariance = 1e-4 * Eigen::Matrix3d::Identity();
  team[1].setPeerPose(team[0].id(), tentative, team.timeOf(1));
  publish(1, {wall(4, 1.0, 1.0, 3.0)});
  EXPECT_EQ(held(1, 1).size(), 1U);
}

TEST_F(Sharing, aDriftCorrectionMovesAnchorsAndSendsNoGeometry) {
  start(2);
  team.connectAll();
  stand(0, {10.0, 0.0, 0.0});
  const std::vector<OwnContour> contours{wall(1, 9.0, 1.0, 3.0), wall(2, 9.0, 2.0, 3.0)};
  publish(0, contours);
  team.run(5.0);
  const std::uint32_t before = held(1, 0).back().name.sequence;
  const std::int64_t bytes = team.recordBytes(0);
  // 0.3 m and 3 degrees; the contours move with the anchor.
  const Pose2 old_pose = team[0].anchorsOf(team[0].id()).back().pose;
  const Pose2 new_pose{10.2, 0.22, 0.05};
  EXPECT_TRUE(team[0].moveAnchor(team[0].anchorsOf(team[0].id()).back().id, new_pose, team.timeOf(0)));
  std::vector<OwnContour> moved = contours;
  for (OwnContour& contour : moved) contour.polygon = transformed(new_pose * old_pose.inverse(), contour.polygon);
  publish(0, moved);
  team.run(5.0);
  EXPECT_EQ(held(1, 0).back().name.sequence, before);
  EXPECT_NEAR(team[1].anchorsOf(team[0].id()).back().pose.y, 0.22, 0.004);
  EXPECT_LE(team.recordBytes(0) - bytes, 60) << "one record of some 14 bytes and its group's head, sent once or twice";
}

TEST_F(Sharing, anchorsStandEveryFewMetresAndOnlyOnce) {
  start(1);
  for (int lap = 0; lap < 3; ++lap) {
    for (int i = 0; i <= 200; ++i) stand(0, {0.1 * i, 0.0, 0.0});
    for (int i = 200; i >= 0; --i) stand(0, {0.1 * i, 0.0, kPi});
  }
  EXPECT_EQ(team[0].anchorsOf(team[0].id()).size(), 6U);
}

TEST_F(Sharing, measuredPosesGoOutAsEdgesBetweenAnchors) {
  start(3);
  team.connectAll();
  stand(0, {8.0, 0.0, 0.0});
  team.run(2.0, [&](std::size_t i) { stand(i, {i == 0 ? 8.0 : 0.0, 0.0, 0.0}); });
  confirm(0, 1, {9.0, 1.0, 0.5});
  team.run(3.0);
  const auto edges = team[2].edges();
  ASSERT_EQ(edges.size(), 1U);
  EXPECT_EQ(edges[0].origin, team[0].id());
  EXPECT_EQ(edges[0].edge.peer, team[1].id());
  EXPECT_EQ(edges[0].edge.state, EdgeState::kConfirmed);
  const Pose2& pose = edges[0].edge.T_anchor_peer.pose;
  EXPECT_NEAR(pose.x, 1.0, 0.01);
  EXPECT_NEAR(pose.y, 1.0, 0.01);
  EXPECT_NEAR(pose.yaw, 0.5, 0.001);
  PeerPose gone;
  gone.T_odom_peer.covariance = 1e-4 * Eigen::Matrix3d::Identity();
  gone.state = EdgeState::kWithdrawn;
  team[0].setPeerPose(team[1].id(), gone, team.timeOf(0));
  team.run(3.0);
  EXPECT_EQ(team[2].edges()[0].edge.state, EdgeState::kWithdrawn);
}

TEST_F(Sharing, longOrKnottedOutlinesAreCutIntoPieces) {
  start(2);
  team.connectAll();
  OwnContour spiral{1, {}, false, false, 0.0};
  for (int i = 0; i < 120; ++i)
    spiral.polygon.push_back({(1.0 + 0.03 * i) * std::cos(0.2 * i), (1.0 + 0.03 * i) * std::sin(0.2 * i)});
  OwnContour eight{2, {{0.0, 0.0}, {1.0, 1.0}, {1.0, 0.0}, {0.0, 1.0}}, true, false, 0.0};
  OwnContour far{3, {{100.0, 0.0}, {101.0, 0.0}}, false, false, 0.0};
  publish(0, {spiral, eight, far});
  team.run(5.0);
  EXPECT_EQ(team[0].counters().contours_refused, 1) << "too far from any anchor";
  double length = 0.0;
  for (const SharedContour& contour : held(1, 0)) length += pathLength(contour.polygon);
  EXPECT_NEAR(length, pathLength(spiral.polygon) + perimeter(eight.polygon), 1.0);
  EXPECT_EQ(team[1].counters().implausible, 0);
}

}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

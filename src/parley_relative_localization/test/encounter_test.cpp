// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "rooms.h"

namespace parley {
namespace {

using test::Actor;
using test::Stage;

void expectRight(const Stage& stage, std::size_t i, std::size_t j) {
  const Pose2 error = stage.errorOf(i, j);
  EXPECT_LT(error.position().norm(), 0.08);
  EXPECT_LT(std::abs(error.yaw), radians(1.5));
}

/// Steps until robot 0 has confirmed robot 1 or the time is over.
bool confirms(Stage& stage, double seconds, const std::string& name = "b") {
  for (const double end = stage.now() + seconds; stage.now() < end;) {
    stage.step();
    if (stage.estimate(0, name).state == PoseState::kConfirmed) return true;
  }
  return false;
}

/// Two robots that drive towards each other in the room, a little off each other's line.
Stage roomMeeting(unsigned seed = 1) {
  Stage stage(test::segmentWorld(test::distinctiveRoom()), seed);
  stage.reserve(3);
  stage.add("a", {1.5, 2.8, 0.1}).twist = {1.0, 0.05};
  stage.add("b", {7.0, 3.4, 3.1}).twist = {0.8, -0.1};
  return stage;
}

}  // namespace

TEST(Encounter, isConfirmedSoonInARoom) {
  for (unsigned seed = 1; seed < 6; ++seed) {
    Stage stage = roomMeeting(seed);
    ASSERT_TRUE(confirms(stage, 3.0)) << seed;
    expectRight(stage, 0, 1);
    const PeerEstimate estimate = stage.estimate(0, "b");
    EXPECT_TRUE(estimate.direct);
    EXPECT_TRUE(isCovariance(estimate.T_odom_peerodom.covariance));
    EXPECT_LT(estimate.age, 0.5);
    EXPECT_GT(estimate.support, 4);
  }
}

TEST(Encounter, isConfirmedInACorridorByMotionAlone) {
  Stage stage(test::segmentWorld(test::corridor()));
  stage.reserve(2);
  stage.add("a", {0.0, 0.6, 0.0}).twist = {1.0, 0.0};
  stage.add("b", {6.0, 1.4, kPi}).twist = {1.0, 0.0};
  ASSERT_TRUE(confirms(stage, 3.0));
  expectRight(stage, 0, 1);
}

TEST(Encounter, standingRobotsAreNeverConfirmed) {
  Stage stage = roomMeeting();
  stage.actor(0).T_world_base = {3.0, 2.8, 0.1};
  stage.actor(1).T_world_base = {5.5, 3.2, 2.0};
  stage.actor(0).twist = stage.actor(1).twist = {};
  EXPECT_FALSE(confirms(stage, 10.0));
  EXPECT_EQ(stage.estimate(0, "b").state, PoseState::kTentative);
  expectRight(stage, 0, 1);
}

TEST(Encounter, aQueueWithASilentRobotInTheMiddleIsNoEncounter) {
  Stage stage(test::segmentWorld(test::corridor()));
  stage.reserve(3);
  for (std::size_t i = 0; i < 3; ++i) {
    stage.add(std::string(1, static_cast<char>('a' + i)), {2.0 * static_cast<double>(i), 1.0, 0.0}).twist = {0.8, 0.0};
  }
  stage.links = {{0, 2}, {2, 0}};
  EXPECT_FALSE(confirms(stage, 12.0, "c"));  // two metres ahead of a it sees b, and c sees b two metres behind
}

TEST(Encounter, aQueueThatTalksIsNotMixedUp) {
  Stage stage(test::segmentWorld(test::corridor()));
  stage.reserve(3);
  for (std::size_t i = 0; i < 3; ++i) {
    stage.add(std::string(1, static_cast<char>('a' + i)), {2.0 * static_cast<double>(i), 1.0, 0.0});
  }
  for (int step = 0; step < 100; ++step) {
    for (std::size_t i = 0; i < 3; ++i) stage.actor(i).twist = {0.8 + 0.5 * std::sin(0.1 * step - static_cast<double>(i)), 0.0};
    stage.step();
    if (stage.estimate(0, "b").state == PoseState::kConfirmed) expectRight(stage, 0, 1);
    if (stage.estimate(0, "c").state == PoseState::kConfirmed) expectRight(stage, 0, 2);
  }
}

TEST(Encounter, robotsInTheSameKindOfRoomElsewhereAreNot) {
  for (const bool mirrored : {false, true}) {
    // Another room 30 m away, the same or its mirror image; each talking robot meets a silent one.
    std::vector<test::WallSegment> walls = test::distinctiveRoom();
    for (const test::WallSegment& wall : test::distinctiveRoom()) {
      const auto moved = [&](const Eigen::Vector2d& p) {
        return Eigen::Vector2d(30.0 + (mirrored ? 9.0 - p.x() : p.x()), p.y());
      };
      walls.push_back({moved(wall.a), moved(wall.b)});
    }
    Stage stage(test::segmentWorld(walls));
    stage.reserve(4);
    stage.add("a", {1.5, 2.8, 0.1}).twist = {1.0, 0.1};
    stage.add("b", {36.5, 3.4, 3.0}).twist = {0.9, 0.1};
    stage.add("c", {6.5, 3.6, 3.0}).twist = {0.7, -0.2};
    stage.add("d", {31.5, 2.5, 0.2}).twist = {1.1, 0.15};
    stage.links = {{0, 1}, {1, 0}};
    EXPECT_FALSE(confirms(stage, 4.0)) << mirrored;
  }
}

TEST(Encounter, twinsInTheSameKindOfRoomAreNotTakenForOneAnother) {
  std::vector<test::WallSegment> walls = test::distinctiveRoom();
  const Eigen::Vector2d far(30.0, 0.0);
  for (const test::WallSegment& wall : test::distinctiveRoom()) walls.push_back({wall.a + far, wall.b + far});
  Stage stage(test::segmentWorld(walls));
  stage.reserve(4);
  for (const char* name : {"a", "b"}) stage.add(name, name[0] == 'a' ? Pose2{2.5, 2.8, 0.1} : Pose2{6.0, 3.4, 3.1});
  for (const char* name : {"c", "d"}) stage.add(name, name[0] == 'c' ? Pose2{32.5, 2.8, 0.1} : Pose2{36.0, 3.4, 3.1});
  stage.links = {{0, 1}, {1, 0}};
  int confirmed = 0;
  for (int step = 0; step < 120; ++step) {
    // In circles, in step with the twins; after three seconds everybody hears everybody.
    for (std::size_t i = 0; i < 4; ++i) stage.actor(i).twist = {i % 2 == 0 ? 0.6 : 0.7, 0.8};
    if (step == 30) stage.links.clear();
    stage.step();
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < 4; ++j) {
        if (i == j || stage.estimate(i, std::string(1, static_cast<char>('a' + j))).state != PoseState::kConfirmed) continue;
        SCOPED_TRACE(testing::Message() << i << " of " << j << " at step " << step);
        expectRight(stage, i, j);
        ++confirmed;
      }
    }
  }
  EXPECT_GT(confirmed, 100);
}

TEST(Encounter, aWrongClockIsEstimated) {
  for (const double offset : {-0.2, -0.1, 0.1, 0.2}) {
    Stage stage = roomMeeting();
    stage.actor(1).clock = offset;
    if (!confirms(stage, 4.0)) continue;  // not to know is allowed, to be wrong is not
    expectRight(stage, 0, 1);
    EXPECT_NEAR(stage.estimate(0, "b").time_offset, offset, 0.06);
  }
}

TEST(Encounter, aSingleMessageIsEnoughWhereverTheLidarSits) {
  for (const double ahead : {0.0, 0.2}) {
    Stage stage = roomMeeting();
    stage.told_span = 1.0;
    stage.actor(1).lidar_base.x() = ahead;
    for (int i = 0; i < 18; ++i) stage.step(false);
    EXPECT_EQ(stage.estimate(0, "b").state, PoseState::kUnknown);
    for (int i = 0; i < 2; ++i) stage.step();  // one of them talks
    for (int i = 0; i < 3; ++i) stage.step(false);
    ASSERT_EQ(stage.estimate(0, "b").state, PoseState::kConfirmed) << ahead;
    expectRight(stage, 0, 1);
  }
}

TEST(Encounter, ofWhatWasSeenMoreThatIsNewIsTold) {
  Stage stage = roomMeeting();
  for (int i = 0; i < 25; ++i) stage.step(false);
  const std::vector<SightReport> all = stage.actor(0).localization.sights(stage.now() - 1.05);
  ASSERT_EQ(all.size(), 4U);
  const double ages[] = {1.0, 0.4, 0.1, 0.0};  // [s]
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(stage.now() - all[i].stamp, ages[i], 0.06) << i;
  const std::vector<SightReport> few = stage.actor(0).localization.sights(stage.now() - 0.15);
  ASSERT_EQ(few.size(), 2U);
  EXPECT_LT(few.front().stamp, few.back().stamp);
}

TEST(Encounter, sameInputsSameAnswers) {
  Stage one = roomMeeting(4), two = roomMeeting(4);
  for (int i = 0; i < 25; ++i) {
    one.step();
    two.step();
    const PeerEstimate a = one.estimate(0, "b"), b = two.estimate(0, "b");
    EXPECT_EQ(a.state, b.state);
    EXPECT_TRUE(a.T_odom_peerodom.pose == b.T_odom_peerodom.pose);
    EXPECT_TRUE(a.T_odom_peerodom.covariance == b.T_odom_peerodom.covariance);
  }
}

TEST(Encounter, aContradictedPoseIsDemoted) {
  Stage stage = roomMeeting();
  ASSERT_TRUE(confirms(stage, 3.0));
  stage.actor(0).twist = stage.actor(1).twist = {};
  Actor& peer = stage.actor(1);
  const Pose2 slipped = peer.odometry() * Pose2{0.0, 1.2, 0.0};  // its odometry believes that it was pushed aside
  peer.T_world_odom = peer.T_world_base * slipped.inverse();
  bool demoted = false;
  for (int i = 0; i < 25 && !demoted; ++i) {
    stage.step();
    demoted = stage.estimate(0, "b").state != PoseState::kConfirmed;
  }
  EXPECT_TRUE(demoted);
  EXPECT_GT(stage.actor(0).localization.counters().demotions, 0);
}

TEST(Encounter, uncertaintyGrowsUntilThePoseExpires) {
  RelativeLocalizationOptions options;
  options.expire_age = 20.0;
  options.drift_translation = 0.1;
  Stage stage(test::segmentWorld(test::distinctiveRoom()));
  stage.reserve(2);
  stage.add("a", {1.5, 2.8, 0.1}, options).twist = {1.0, 0.05};
  stage.add("b", {7.0, 3.4, 3.1}).twist = {0.8, -0.1};
  ASSERT_TRUE(confirms(stage, 3.0));
  double last = stage.estimate(0, "b").T_odom_peerodom.covariance(0, 0);
  stage.actor(0).twist = stage.actor(1).twist = {0.3, 1.5};
  stage.actor(1).T_world_base = {60.0, 3.0, 0.0};
  stage.actor(1).T_world_odom = stage.actor(1).T_world_base * Pose2{1.0, 0.0, 0.0};
  bool was_tentative = false;
  for (int i = 0; i < 400; ++i) {
    stage.step(false);
    const PeerEstimate estimate = stage.estimate(0, "b");
    was_tentative = was_tentative || estimate.state == PoseState::kTentative;
    if (estimate.state != PoseState::kConfirmed) continue;
    if (i % 50 == 49) {
      EXPECT_GT(estimate.T_odom_peerodom.covariance(0, 0), last);
      last = estimate.T_odom_peerodom.covariance(0, 0);
    }
  }
  EXPECT_EQ(stage.estimate(0, "b").state, PoseState::kUnknown);
}

TEST(Encounter, whoMeetsTwoJoinsThem) {
  Stage stage = roomMeeting();
  ASSERT_TRUE(confirms(stage, 3.0));
  const Actor &a = stage.actor(0), &b = stage.actor(1);
  const Pose2 T_world_codom{40.0, -3.0, 1.0}, T_world_c{44.0, 2.0, -2.0};
  RelativeEdge edge;
  edge.from = "c";
  edge.to = "b";
  edge.stamp = stage.now();
  edge.T_odom_from = T_world_codom.inverse() * T_world_c;
  edge.T_odom_to = b.odometry();
  edge.travel_from = 3.0;
  edge.travel_to = b.localization.travel();
  edge.T_from_to = {T_world_c.inverse() * b.T_world_base, Eigen::Vector3d(1e-4, 1e-4, 1e-5).asDiagonal()};
  stage.actor(0).localization.addEdge(edge);
  for (int i = 0; i < 10; ++i) stage.step();
  const PeerEstimate c = stage.estimate(0, "c");
  ASSERT_EQ(c.state, PoseState::kConfirmed);
  EXPECT_FALSE(c.direct);
  const Pose2 truth = a.T_world_odom.inverse() * T_world_codom;
  const Pose2 place = c.T_odom_peerodom.pose * edge.T_odom_from, true_place = truth * edge.T_odom_from;
  EXPECT_LT((place.position() - true_place.position()).norm(), 1.0);
  ASSERT_FALSE(a.localization.edges().empty());
  EXPECT_EQ(a.localization.edges().front().to, "b");
}

TEST(Encounter, whoIsKnownElsewhereIsNotWhoIsSeen) {
  for (const bool known : {false, true}) {
    // Two meetings in step with each other, 30 m apart in a corridor; one robot of each is silent.
    Stage stage(test::segmentWorld(test::corridor()));
    stage.reserve(4);
    stage.add("a", {0.0, 0.6, 0.0});
    stage.add("b", {36.0, 1.4, kPi});
    stage.add("silent", {6.0, 1.4, kPi});
    stage.add("image", {30.0, 0.6, 0.0});
    for (std::size_t i = 0; i < 4; ++i) stage.actor(i).twist = {1.0, 0.0};
    stage.links = {{0, 1}, {1, 0}};
    stage.step();
    const Actor &a = stage.actor(0), &b = stage.actor(1);
    const PoseEstimate told{b.T_world_base.inverse() * a.T_world_base, Eigen::Vector3d(1e-3, 1e-3, 1e-5).asDiagonal()};
    if (known)
      stage.actor(0).localization.addEdge(
          {"b", "a", stage.now(), b.odometry(), a.odometry(), b.localization.travel(), a.localization.travel(), told});
    bool is_taken_for_another = false;
    for (int i = 0; i < 30; ++i) {
      stage.step();
      const bool is_confirmed = stage.estimate(0, "b").state == PoseState::kConfirmed;
      is_taken_for_another = is_taken_for_another || (is_confirmed && stage.errorOf(0, 1).position().norm() > 1.0);
    }
    EXPECT_EQ(is_taken_for_another, !known);
  }
}

TEST(Encounter, whatStandsCouldBeAnything) {
  // It drives up to a silent robot that stands. Elsewhere a peer stands like that one, before which something stops as it does.
  Stage stage(test::segmentWorld(test::corridor()));
  stage.reserve(4);
  stage.add("a", {0.0, 0.6, 0.0});
  stage.add("b", {33.8, 1.4, kPi});
  stage.add("silent", {3.8, 1.4, kPi});
  stage.add("image", {60.0, 0.6, 0.0});
  stage.links = {{0, 1}, {1, 0}};
  for (int i = 0; i < 50; ++i) {
    stage.actor(0).twist = {i < 20 ? 0.8 : 0.0, 0.0};
    if (i == 20) stage.actor(3).T_world_base = {31.6, 0.6, 0.0};
    stage.step();
    EXPECT_NE(stage.estimate(0, "b").state, PoseState::kConfirmed) << i;
  }
}

TEST(Encounter, geometryAloneIsTentativeAtMost) {
  // A pillar hides the robots from each other; they still tell what they see of the room.
  Stage stage(test::segmentWorld(test::distinctiveRoom() + test::box({4.3, 1.2}, {4.7, 4.6})));
  stage.reserve(2);
  stage.add("a", {2.5, 2.0, 1.5}).twist = {0.4, 0.05};
  stage.add("b", {6.3, 2.2, 1.5}).twist = {0.4, -0.05};
  EXPECT_FALSE(confirms(stage, 6.0));
  EXPECT_GT(stage.actor(0).localization.counters().global_searches, 2);
  EXPECT_LE(stage.actor(0).localization.counters().global_searches, 7);
  if (stage.estimate(0, "b").state == PoseState::kTentative) expectRight(stage, 0, 1);
}

}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

// SPDX-License-Identifier: BSD-3-Clause
// Robots that meet, each with a frame of its own, a clock of its own and nothing else in common but a key.
#include "parley_robot/team_link.h"

#include <gtest/gtest.h>

#include <array>

#include "meeting.h"

namespace parley {
namespace {

using test::box;
using test::Meeting;
using test::Robot;
using test::Wall;

/// A hall with pillars, 16 x 8 m, wide enough to pass.
std::vector<Wall> hall() {
  std::vector<Wall> walls = box(0.0, 0.0, 16.0, 8.0);
  for (const auto& [x, y] :
       std::vector<std::pair<double, double>>{{4.0, 1.2}, {6.5, 6.9}, {9.0, 0.9}, {11.0, 6.6}, {13.5, 2.0}}) {
    for (const Wall& wall : box(x, y, x + 0.7, y + 0.5)) walls.push_back(wall);
  }
  return walls;
}

}  // namespace

TEST(TeamLink, robotsThatMeetKnowWhereTheOtherIs) {
  Meeting meeting(hall());
  Robot& a = meeting.add("ann", {1.5, 3.0, 0.2}, 0.0);
  Robot& b = meeting.add("bob", {14.5, 5.0, 3.0}, 812.3);  // another clock
  a.go({14.5, 3.2});
  b.go({1.5, 5.2});
  meeting.run(14.0);
  const auto a_of_b = Meeting::errorOf(a, b, "bob"), b_of_a = Meeting::errorOf(b, a, "ann");
  ASSERT_TRUE(a_of_b && b_of_a);
  EXPECT_LT(*a_of_b, 0.12);
  EXPECT_LT(*b_of_a, 0.12);
  EXPECT_EQ(a.output.state, DriveState::kArrived);
  EXPECT_EQ(b.output.state, DriveState::kArrived);
  EXPECT_EQ(a.stack.team()->teammates().at(robotIdOf("bob")).name, "bob");
}

/// Two robots pass each other; how many seconds of ten each of them knows where the other is, in the mean over both. [s]
double secondsKnown(int max_reports, double loss, unsigned seed) {
  Meeting meeting(hall(), seed);
  meeting.loss = loss;
  RobotOptions ann = test::optionsOf("ann", Variant::kFull), bob = test::optionsOf("bob", Variant::kFull);
  ann.relative_localization.max_reports = bob.relative_localization.max_reports = max_reports;
  Robot& a = meeting.add(ann, {1.5, 3.0, 0.2}, 0.0);
  Robot& b = meeting.add(bob, {14.5, 5.0, 3.0}, 0.0);
  a.go({14.5, 3.2});
  b.go({1.5, 5.2});
  double known = 0.0;
  while (meeting.time() < 10.0) {
    meeting.run(0.1);
    for (const auto& error : {Meeting::errorOf(a, b, "bob"), Meeting::errorOf(b, a, "ann")}) {
      if (!error) continue;
      EXPECT_LT(*error, 0.3) << "seed " << seed;
      known += 0.05;
    }
  }
  return known;
}

/// At 80 % of losses it is 15 % more over 20 seeds, which a few do not show.
TEST(TeamLink, whereMuchIsLostTellingAgainHelps) {
  constexpr int kSeeds = 6;
  double once = 0.0, again = 0.0;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    once += secondsKnown(1, 0.9, seed) / kSeeds;
    again += secondsKnown(4, 0.9, seed) / kSeeds;
  }
  std::printf("90 %% lost: known for %.2f s, with sightings told again %.2f s\n", once, again);
  EXPECT_GT(again, 1.5 * once);
}

TEST(TeamLink, mapsAreSharedOnlyWhereThatIsWanted) {
  for (const Variant variant : {Variant::kFull, Variant::kNoSharing}) {
    Meeting meeting(hall());
    Robot& a = meeting.add("ann", {1.5, 3.0, 0.2}, 0.0, variant);
    Robot& b = meeting.add("bob", {14.5, 5.0, 3.0}, 0.0, variant);
    a.go({14.5, 3.2});
    b.go({1.5, 5.2});
    meeting.run(8.0);
    ASSERT_TRUE(Meeting::errorOf(a, b, "bob"));
    // At the far end there are walls that only the other one has seen.
    const bool sharing = variant == Variant::kFull;
    constexpr std::size_t kNewest = 3;  // pieces by which the scan since the last update of the fused map may differ
    EXPECT_EQ(a.stack.topology().fusedContours().size() > a.stack.topology().contours().size() + kNewest, sharing);
    EXPECT_EQ(a.stack.team()->exchange().contoursOf(robotIdOf("bob")).empty(), !sharing);
  }
}

TEST(TeamLink, aRobotThatStartsAnewIsAnotherOne) {
  Meeting meeting(hall());
  Robot& a = meeting.add("ann", {1.5, 3.0, 0.2}, 0.0);
  Robot& b = meeting.add("bob", {14.5, 5.0, 3.0}, 0.0);
  a.go({14.5, 3.2});
  b.go({1.5, 5.2});
  meeting.run(8.0);
  ASSERT_TRUE(Meeting::errorOf(a, b, "bob"));
  b.T_world_odom = Pose2{3.0, -4.0, 1.0} * b.T_world_odom;  // its odometry jumps
  meeting.run(3.0);
  EXPECT_EQ(b.stack.counters().odometry_jumps, 1);
  const auto error = Meeting::errorOf(a, b, "bob");
  EXPECT_TRUE(!error || *error < 0.3) << *error;  // what was known is not believed of the new frame
}

TEST(TeamLink, aCorrectionOfOdometryIsNothingThatOthersNotice) {
  std::array<double, 2> told{};  // [byte] of the map, without and with a correction
  for (const bool corrected : {false, true}) {
    Meeting meeting(hall());
    Robot& a = meeting.add("ann", {1.5, 3.0, 0.2}, 0.0);
    Robot& b = meeting.add("bob", {14.5, 5.0, 3.0}, 0.0);
    a.go({14.5, 3.2});
    b.go({1.5, 5.2});
    meeting.run(6.0);
    ASSERT_TRUE(Meeting::errorOf(a, b, "bob") && Meeting::errorOf(b, a, "ann"));
    ASSERT_GT(b.drive.twist.speed, 0.5);
    const auto mapBytes = [&b] { return static_cast<double>(b.stack.team()->exchange().counters().sections_sent.map); };
    const double before = mapBytes();
    const std::vector<SharedAnchor> anchors = a.stack.team()->exchange().anchorsOf(robotIdOf("bob"));
    // 0.3 m and 3 degrees off what it was, where the robot is.
    if (corrected) b.T_world_odom = b.drive.pose * Pose2{0.2, -0.22, 0.052} * b.odometry().inverse();
    for (int i = 0; i < 15; ++i) {
      meeting.run(0.2);
      const auto a_of_b = Meeting::errorOf(a, b, "bob"), b_of_a = Meeting::errorOf(b, a, "ann");
      ASSERT_TRUE(a_of_b && b_of_a) << i;
      EXPECT_LT(*a_of_b, 0.12) << i;
      EXPECT_LT(*b_of_a, 0.12) << i;
    }
    EXPECT_EQ(b.stack.counters().odometry_corrections, corrected ? 1 : 0);
    EXPECT_EQ(b.stack.counters().odometry_jumps, 0);
    told[corrected ? 1 : 0] = mapBytes() - before;
    for (const SharedAnchor& anchor : anchors) {
      for (const SharedAnchor& now : a.stack.team()->exchange().anchorsOf(robotIdOf("bob"))) {
        EXPECT_TRUE(now.id != anchor.id || now.pose == anchor.pose);
      }
    }
    meeting.run(7.0);
    EXPECT_EQ(b.output.state, DriveState::kArrived);
    const Eigen::Vector2d goal = b.T_world_odom * (Pose2{14.5, 5.0, 3.0}.inverse() * Eigen::Vector2d(1.5, 5.2));
    EXPECT_LT((b.drive.pose.position() - goal).norm(), 0.3) << "where odometry now has it";
  }
  std::printf("3 s of map: %.0f byte, with a correction %.0f\n", told[0], told[1]);
  EXPECT_LT(told[1], 1.25 * told[0] + 50.0);
}

TEST(TeamLink, aThirdIsKnownThroughTheSecond) {
  Meeting meeting(hall());
  Robot& a = meeting.add("ann", {1.5, 3.0, 0.2}, 0.0);
  Robot& b = meeting.add("bob", {14.5, 5.0, 3.0}, 0.0);
  Robot& c = meeting.add("cleo", {14.8, 2.0, 1.6}, 0.0);
  a.go({8.0, 3.2});
  b.go({7.0, 5.2});
  c.go({12.0, 4.6});
  meeting.run(9.0);
  b.go({13.0, 5.4});
  meeting.run(8.0);
  ASSERT_TRUE(Meeting::errorOf(b, c, "cleo"));
  ASSERT_TRUE(Meeting::errorOf(b, a, "ann"));
  const auto error = Meeting::errorOf(a, c, "cleo");
  ASSERT_TRUE(error);
  EXPECT_LT(*error, 0.3);
}

TEST(TeamLink, silenceChangesNothing) {
  Meeting meeting(hall());
  Robot& a = meeting.add("ann", {1.5, 3.0, 0.2}, 0.0);
  Robot& b = meeting.add("bob", {14.5, 5.0, 3.0}, 0.0, Variant::kReactive);
  a.go({14.5, 3.2});
  b.go({1.5, 5.2});
  meeting.run(14.0);
  EXPECT_EQ(b.stack.team(), nullptr);
  EXPECT_TRUE(a.stack.team()->teammates().empty());
  EXPECT_EQ(a.output.state, DriveState::kArrived);
}

}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

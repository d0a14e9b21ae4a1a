// SPDX-License-Identifier: BSD-3-Clause
// What one robot has seen changes what another does.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <functional>
#include <set>

#include "meeting.h"

namespace parley {
namespace {

using test::box;
using test::Meeting;
using test::Robot;
using test::Wall;

/// A hall of 24 by 14 m with a dead end 4 m wide and 9 m deep that opens towards the left.
std::vector<Wall> deadEnd() {
  std::vector<Wall> walls = box(0.0, 0.0, 24.0, 14.0);
  walls.push_back({{9.0, 5.0}, {18.0, 5.0}});
  walls.push_back({{9.0, 9.0}, {18.0, 9.0}});
  walls.push_back({{18.0, 5.0}, {18.0, 9.0}});
  return walls;
}

/// Two rooms of 10 by 14 m with two doors of 1.6 m, at y = 3 and y = 11; each may be shut.
std::vector<Wall> twoDoors(bool near_open) {
  std::vector<Wall> walls = box(0.0, 0.0, 20.0, 14.0);
  walls.push_back({{10.0, 0.0}, {10.0, 2.2}});
  walls.push_back({{10.0, 3.8}, {10.0, 10.2}});
  walls.push_back({{10.0, 11.8}, {10.0, 14.0}});
  if (!near_open) walls.push_back({{10.0, 2.2}, {10.0, 3.8}});
  return walls;
}

/// Runs until the robot has arrived or the time is up; `look` is called ten times a second.
void runUntilArrived(Meeting& meeting, const Robot& robot, double seconds, const std::function<void()>& look) {
  const double end = meeting.time() + seconds;
  do {
    meeting.run(0.1);
    look();
  } while (meeting.time() < end && robot.output.state != DriveState::kArrived);
}

/// Ann comes out of the dead end; she and bob get to know each other.
void haveAnnMeetBob(Meeting& meeting, Robot& ann, Robot& bob) {
  ann.go({5.0, 6.0});
  meeting.run(7.0);
  bob.go({6.0, 8.0});
  meeting.run(5.0);
  bob.go({4.0, 9.0});
  meeting.run(4.0);
  EXPECT_TRUE(Meeting::errorOf(bob, ann, "ann"));
}

/// How far bob goes into the dead end on his way past it, after ann has come out of it and has met him. [m]
double depthOfBobsVisit(Variant variant) {
  Meeting meeting(deadEnd());
  Robot& ann = meeting.add("ann", {16.5, 7.0, 3.1}, 0.0, variant);
  Robot& bob = meeting.add("bob", {4.0, 8.5, 0.0}, 55.0, variant);
  haveAnnMeetBob(meeting, ann, bob);
  bob.go({21.0, 7.0});
  double depth = 0.0;
  runUntilArrived(meeting, bob, 60.0, [&] {
    const Pose2& pose = bob.drive.pose;
    if (pose.y > 5.0 && pose.y < 9.0 && pose.x < 18.0) depth = std::max(depth, pose.x - 9.0);
  });
  EXPECT_EQ(bob.output.state, DriveState::kArrived);
  EXPECT_LE(bob.output.route_switches, 2);  // what he sees himself, and what he is told
  return depth;
}

TEST(TeamMap, aDeadEndIsEnteredOnceForAll) {
  EXPECT_LT(depthOfBobsVisit(Variant::kFull), 1.0);
  EXPECT_GT(depthOfBobsVisit(Variant::kNoSharing), 3.0);
}

/// Corners of what a robot holds to be in the dead end, in its odom frame.
std::set<std::pair<double, double>> cornersInDeadEnd(const Robot& robot) {
  std::set<std::pair<double, double>> corners;
  for (const Contour& contour : robot.stack.topology().fusedContours()) {
    for (const Eigen::Vector2d& corner : contour.polygon) {
      const Eigen::Vector2d place = robot.T_world_odom * corner;
      if (place.x() > 12.0 && place.y() > 4.0 && place.y() < 10.0) corners.emplace(corner.x(), corner.y());
    }
  }
  return corners;
}

TEST(TeamMap, aTeammatesMapLiesStillWhileItsPoseIsMeasuredAgainAndAgain) {
  Meeting meeting(deadEnd());
  Robot& ann = meeting.add("ann", {16.5, 7.0, 3.1}, 0.0);
  Robot& bob = meeting.add("bob", {4.0, 8.5, 0.0}, 55.0);
  Robot& cleo = meeting.add("cleo", {2.0, 2.0, 0.5}, 0.0);
  haveAnnMeetBob(meeting, ann, bob);
  const auto pose = [&bob] { return bob.stack.team()->teammates().at(robotIdOf("ann")).estimate.T_odom_peerodom.pose; };
  int measured = 0, drawn_anew = 0;
  Pose2 last = pose();
  std::set<std::pair<double, double>> corners = cornersInDeadEnd(bob);
  ASSERT_GT(corners.size(), 8U);
  for (int second = 0; second < 24; ++second) {
    ann.go({second % 8 < 4 ? 8.0 : 2.5, 3.0});
    cleo.go({second % 6 < 3 ? 2.0 : 7.0, 1.5});  // what she measures bears on what bob knows of ann
    meeting.run(1.0);
    measured += !(pose() == last);
    last = pose();
    std::set<std::pair<double, double>> now = cornersInDeadEnd(bob);
    drawn_anew += now != corners;
    corners = std::move(now);
  }
  EXPECT_GE(measured, 4);
  EXPECT_EQ(drawn_anew, 0);
}

TEST(TeamMap, whatAThirdSawLiesWhereItIsWithinItsDeviation) {
  Meeting meeting(deadEnd());
  Robot& ann = meeting.add("ann", {2.0, 2.0, 0.5}, 0.0);
  Robot& bob = meeting.add("bob", {6.0, 7.0, 0.0}, 40.0);
  Robot& cleo = meeting.add("cleo", {16.0, 7.0, 3.1}, -3.0);
  ann.radio = false;
  cleo.go({9.5, 7.4});
  bob.go({7.0, 6.5});
  meeting.run(9.0);
  ASSERT_TRUE(Meeting::errorOf(bob, cleo, "cleo"));
  ann.radio = true;
  cleo.radio = false;  // what ann knows of her comes through bob alone
  bob.go({3.5, 4.0});
  ann.go({3.0, 2.0});
  meeting.run(10.0);
  ASSERT_TRUE(Meeting::errorOf(ann, bob, "bob"));
  const RobotId id = robotIdOf("cleo");
  const Exchange& exchange = ann.stack.team()->exchange();
  ASSERT_FALSE(exchange.contoursOf(id).empty());
  const PoseEstimate& T = ann.stack.team()->teammates().at(id).estimate.T_odom_peerodom;
  const Pose2 T_truth = ann.T_world_odom.inverse() * cleo.T_world_odom;
  std::map<std::uint32_t, Pose2> anchors;
  for (const SharedAnchor& anchor : exchange.anchorsOf(id)) anchors[anchor.id] = anchor.pose;
  int corners = 0;
  for (const SharedContour& contour : exchange.contoursOf(id)) {
    EXPECT_GE(contour.hops, 2);
    if (anchors.count(contour.anchor) == 0) continue;  // comes later
    for (const Eigen::Vector2d& corner : transformed(anchors.at(contour.anchor), contour.polygon)) {
      ++corners;
      const Eigen::Matrix2d covariance = pointCovariance(T, corner);
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(covariance, Eigen::EigenvaluesOnly);
      EXPECT_LT((T.pose * corner - T_truth * corner).norm(), 2.0 * std::sqrt(solver.eigenvalues().maxCoeff()));
    }
  }
  EXPECT_GT(corners, 10);
}

bool wayIsThroughTheNearDoor(const Robot& robot) {
  const Route& route = robot.stack.route();
  for (std::size_t i = 0; i + 1 < route.points.size(); ++i) {
    const Eigen::Vector2d a = robot.T_world_odom * route.points[i], b = robot.T_world_odom * route.points[i + 1];
    if ((a.x() < 10.0) == (b.x() < 10.0)) continue;
    const double y = a.y() + (b.y() - a.y()) * (10.0 - a.x()) / (b.x() - a.x());
    return y < 7.0;
  }
  return false;
}

/// ann stays at the near door; bob has seen it too, as it was then, and is away from it when it changes.
class Doors : public testing::Test {
 protected:
  void meetAtTheDoor(bool open) {
    meeting_.setWalls(twoDoors(open));
    ann_.go({7.6, 4.6});
    bob_.go({7.6, 2.6});
    meeting_.run(9.0);
    ASSERT_TRUE(Meeting::errorOf(bob_, ann_, "ann"));
    bob_.go({2.0, 6.0});
    meeting_.run(14.0);
    ASSERT_EQ(bob_.output.state, DriveState::kArrived);
  }
  /// Where bob would go now, from a place where he sees neither door.
  bool bobWouldTakeTheNearDoor() {
    bob_.go({17.0, 3.0});
    meeting_.run(0.5);
    return wayIsThroughTheNearDoor(bob_);
  }

  Meeting meeting_{twoDoors(true)};
  Robot& ann_ = meeting_.add("ann", {4.0, 5.5, 0.0}, 0.0);
  Robot& bob_ = meeting_.add("bob", {4.0, 3.0, 0.0}, 100.0);
};

TEST_F(Doors, oneThatShutsIsGoneRoundByAllWhoHearOfIt) {
  meetAtTheDoor(true);
  meeting_.setWalls(twoDoors(false));
  meeting_.run(6.0);
  EXPECT_FALSE(bobWouldTakeTheNearDoor());
}

TEST_F(Doors, oneThatOpensIsUsedByAllWhoHearOfIt) {
  meetAtTheDoor(false);
  ASSERT_FALSE(bobWouldTakeTheNearDoor());
  bob_.go({2.0, 6.0});
  meeting_.setWalls(twoDoors(true));
  meeting_.run(6.0);
  EXPECT_TRUE(bobWouldTakeTheNearDoor());
}

TEST_F(Doors, withoutATeammateNothingIsHeard) {
  meetAtTheDoor(true);
  ann_.radio = false;
  meeting_.setWalls(twoDoors(false));
  meeting_.run(6.0);
  EXPECT_TRUE(bobWouldTakeTheNearDoor());
}

/// bob is carried off without his odometry noticing: what ann believes of him is wrong from then on.
TEST(TeamMap, aWrongMergeDoesNotKeepARobotFromItsGoal) {
  Meeting meeting(deadEnd());
  Robot& ann = meeting.add("ann", {3.0, 3.0, 0.0}, 0.0);
  Robot& bob = meeting.add("bob", {6.0, 3.5, 3.1}, 20.0);
  ann.go({4.0, 3.0});
  bob.go({7.0, 4.0});
  meeting.run(8.0);
  ASSERT_TRUE(Meeting::errorOf(ann, bob, "bob"));
  const Pose2 odometry = bob.odometry();
  bob.drive.pose = {6.5, 10.5, -1.0};
  bob.T_world_odom = bob.drive.pose * odometry.inverse();
  bob.go({5.0, 12.0});
  ann.go({21.0, 7.0});
  double wrong_for = 0.0;
  runUntilArrived(meeting, ann, 90.0, [&] {
    const auto error = Meeting::errorOf(ann, bob, "bob");
    if (error && *error > 0.5) wrong_for += 0.1;
  });
  EXPECT_EQ(ann.output.state, DriveState::kArrived);
  EXPECT_LT(wrong_for, 3.0);
}

}  // namespace
}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

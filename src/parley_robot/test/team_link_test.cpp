// SPDX-License-Identifier: BSD-3-Clause
// Robots that meet, each with a frame of its own, a clock of its own and nothing else in common but a key.
#include "parley_robot/team_link.h"

#include <gtest/gtest.h>

#include <deque>

#include "parley_robot/robot_stack.h"
#include "test_world.h"

namespace parley {
namespace {

using test::box;
using test::IdealDrive;
using test::Wall;

RobotOptions optionsOf(const std::string& name, Variant variant) {
  RobotOptions options;
  options.name = name;
  options.footprint = {0.8, 0.4};
  options.limits = {2.0, 1.5708, 2.0, 4.0};
  options.key = simulatedTeamKey(7);
  options.variant = variant;
  return options;
}

struct Robot {
  Robot(const std::string& name, const Pose2& start, double clock_ahead, Variant variant = Variant::kFull)
      : stack(optionsOf(name, variant)), T_world_odom(start), clock(clock_ahead) {
    drive.pose = start;
  }
  Pose2 odometry() const { return T_world_odom.inverse() * drive.pose; }
  void go(const Eigen::Vector2d& goal_world) { stack.setGoal(T_world_odom.inverse() * goal_world); }

  RobotStack stack;
  Pose2 T_world_odom;
  double clock;  // [s] ahead of the world's
  IdealDrive drive;
  bool radio = true;
  RobotOutput output;
};

/// Robots in one world, in lockstep at 50 Hz, with a radio that delays by a step.
class Meeting {
 public:
  explicit Meeting(std::vector<Wall> walls) : walls_(std::move(walls)) {}
  Robot& add(const std::string& name, const Pose2& start, double clock_ahead, Variant variant = Variant::kFull) {
    return robots_.emplace_back(name, start, clock_ahead, variant);
  }
  void run(double seconds) {
    for (const double end = time_ + seconds; time_ < end;) step();
  }
  double time() const { return time_; }

  /// How far off a robot's idea of another's place is; nullopt unless it is confirmed. [m]
  static std::optional<double> errorOf(const Robot& robot, const Robot& other, const std::string& name) {
    const auto& teammates = robot.stack.team()->teammates();
    const auto found = teammates.find(robotIdOf(name));
    if (found == teammates.end() || found->second.estimate.state != PoseState::kConfirmed) return std::nullopt;
    const Pose2 believed = robot.T_world_odom * found->second.estimate.T_odom_peerodom.pose * other.odometry();
    return (believed.position() - other.drive.pose.position()).norm();
  }

 private:
  void step() {
    time_ += 0.02;
    ++count_;
    for (std::size_t i = 0; i < robots_.size(); ++i) {
      Robot& robot = robots_[i];
      const double now = time_ + robot.clock;
      robot.stack.addOdometry({now, robot.odometry(), robot.drive.twist, 0.0, 0.0});
      if (count_ % 5 == static_cast<int>(i) % 5) robot.stack.addScan(test::scanFrom(seenBy(i), robot.drive.pose, now));
      for (std::size_t k = 0; k < robots_.size(); ++k) {
        if (k == i || !robots_[k].radio || !robot.radio) continue;
        for (const Packet& packet : sent_[k]) robot.stack.addPacket(packet);
      }
      robot.output = robot.stack.step(now);
      robot.drive.step(robot.output.twist, {2.0, 1.5708, 2.0, 4.0}, 0.02);
    }
    sent_.assign(robots_.size(), {});
    for (std::size_t i = 0; i < robots_.size(); ++i) sent_[i] = robots_[i].output.packets;
  }

  std::vector<Wall> seenBy(std::size_t i) const {
    std::vector<Wall> walls = walls_;
    for (std::size_t k = 0; k < robots_.size(); ++k) {
      if (k == i) continue;
      const Polygon body = Footprint{0.8, 0.4}.polygonAt(robots_[k].drive.pose);
      for (std::size_t c = 0; c < body.size(); ++c) walls.push_back({body[c], body[(c + 1) % body.size()]});
    }
    return walls;
  }

  std::vector<Wall> walls_;
  std::deque<Robot> robots_;
  std::vector<std::vector<Packet>> sent_ = std::vector<std::vector<Packet>>(8);
  double time_ = 0.0;
  int count_ = 0;
};

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
    EXPECT_EQ(a.stack.topology().fusedContours().size() > a.stack.topology().contours().size(), sharing);
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

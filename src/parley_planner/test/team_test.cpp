// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "team_loop.h"

namespace parley {
namespace {

struct Case {
  const char* name;
  World (*world)();
  std::vector<TeamMember> members;
  double duration;  // [s]
};

World hall() {
  World world(10, 10, true);
  world.fill(0.5, 0.5, 9.5, 9.5, false);
  return world;
}

/// Two rooms joined by a corridor of a width [m] along y = 5.
World corridor(double width) {
  World world(10, 10, true);
  world.fill(0.3, 3.0, 2.7, 7.0, false);
  world.fill(7.3, 3.0, 9.7, 7.0, false);
  world.fill(2.5, 5.0 - 0.5 * width, 7.5, 5.0 + 0.5 * width, false);
  return world;
}
World narrow() { return corridor(1.0); }
World passable() { return corridor(1.3); }
World wide() { return corridor(2.0); }

World doorway() {
  World world = hall();
  world.fill(4.8, 0.0, 5.2, 4.5, true);
  world.fill(4.8, 5.5, 5.2, 10.0, true);
  return world;
}

World crossing() {
  World world(10, 10, true);
  world.fill(0.5, 4.3, 9.5, 5.7, false);
  world.fill(4.3, 0.5, 5.7, 9.5, false);
  for (const double x : {0.5, 7.5}) world.fill(x, 3.5, x + 2.0, 6.5, false);
  for (const double y : {0.5, 7.5}) world.fill(3.5, y, 6.5, y + 2.0, false);
  return world;
}

/// A dead end 1.2 m wide that opens into a room on the left.
World pocket() {
  World world(10, 10, true);
  world.fill(0.3, 3.0, 4.0, 7.0, false);
  world.fill(3.9, 4.4, 9.5, 5.6, false);
  return world;
}

TeamMember from(double x, double y, double yaw, double goal_x, double goal_y) { return {{x, y, yaw}, {goal_x, goal_y}}; }

class TeamTest : public testing::TestWithParam<Case> {};

TEST_P(TeamTest, AllReachTheirGoalsAndNobodyTouchesAnything) {
  const World world = GetParam().world();
  TeamLoop team(world, GetParam().members);
  team.run(GetParam().duration);
  EXPECT_TRUE(team.allReached()) << "after " << team.time() << " s";
  EXPECT_EQ(team.collisions(), 0);
  EXPECT_EQ(team.flaw(), "");
}

INSTANTIATE_TEST_SUITE_P(
    Conflicts, TeamTest,
    testing::Values(Case{"head_on_in_a_hall", hall, {from(1.5, 5, 0, 8.5, 5), from(8.5, 5, kPi, 1.5, 5)}, 20.0},
                    Case{"head_on_wide", wide, {from(1.5, 5, 0, 8.5, 5), from(8.5, 5, kPi, 1.5, 5)}, 25.0},
                    Case{"head_on_passable", passable, {from(1.5, 5, 0, 8.5, 5), from(8.5, 5, kPi, 1.5, 5)}, 40.0},
                    Case{"head_on_narrow", narrow, {from(1.5, 5, 0, 8.5, 5), from(8.5, 5, kPi, 1.5, 5)}, 60.0},
                    Case{"nose_to_nose", passable, {from(4.4, 5, 0, 8.5, 5), from(5.6, 5, kPi, 1.5, 5)}, 60.0},
                    Case{"two_against_two",
                         passable,
                         {from(2.0, 4.4, 0, 8.5, 4), from(2.0, 5.6, 0, 8.5, 6), from(8.0, 4.4, kPi, 1.2, 4),
                          from(8.0, 5.6, kPi, 1.2, 6)},
                         90.0},
                    Case{"doorway",
                         doorway,
                         {from(2.0, 3.5, 0, 8.0, 3.0), from(2.0, 6.5, 0, 8.0, 7.0), from(8.0, 3.5, kPi, 2.0, 3.0),
                          from(8.0, 6.5, kPi, 2.0, 7.0)},
                         60.0},
                    Case{"crossing",
                         crossing,
                         {from(1.2, 5, 0, 8.8, 5), from(8.8, 5, kPi, 1.2, 5), from(5, 1.2, 0.5 * kPi, 5, 8.8),
                          from(5, 8.8, -0.5 * kPi, 5, 1.2)},
                         90.0},
                    Case{"one_stands_at_its_goal", passable, {from(5.0, 5, 0, 5.0, 5), from(1.5, 5, 0, 8.5, 5)}, 60.0},
                    Case{"swapped_in_a_dead_end", pocket, {from(5.0, 5, 0, 8.0, 5), from(8.0, 5, kPi, 5.0, 5)}, 90.0},
                    Case{"of_three_sizes",
                         wide,
                         {TeamMember{{1.5, 5, 0}, {8.5, 5}, {0.5, 0.4}}, TeamMember{{8.5, 5, kPi}, {1.5, 5}, {1.0, 0.6}},
                          TeamMember{{8.5, 4, kPi}, {1.5, 4}, {0.8, 0.4}}},
                         60.0}),
    [](const auto& made) { return made.param.name; });

TEST(Team, WhoArrivedMakesRoomAndComesBack) {
  const World world = passable();
  TeamLoop team(world, {from(6.0, 5, 0, 6.0, 5), from(1.5, 5, 0, 8.5, 5)});
  team.run(60.0);
  ASSERT_TRUE(team.allReached());
  EXPECT_GE(team.escapes(), 1);
  TeamLoop alone(world, {from(6.0, 5, 0, 6.0, 5)});
  alone.run(10.0);
  EXPECT_EQ(alone.escapes(), 0);
}

TEST(Team, SameRunsAreTheSame) {
  const World world = doorway();
  const std::vector<TeamMember> members = {from(2.0, 3.5, 0, 8.0, 3.0), from(8.0, 3.5, kPi, 2.0, 3.0)};
  TeamLoop a(world, members), b(world, members);
  a.run(15.0);
  b.run(15.0);
  EXPECT_EQ(a.time(), b.time());
  for (const std::size_t i : {0, 1}) {
    EXPECT_EQ(a.state(i).pose.x, b.state(i).pose.x);
    EXPECT_EQ(a.state(i).pose.y, b.state(i).pose.y);
  }
}

}  // namespace
}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

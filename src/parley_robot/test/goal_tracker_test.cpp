// SPDX-License-Identifier: BSD-3-Clause
#include "parley_robot/goal_tracker.h"

#include <gtest/gtest.h>

#include <limits>

namespace parley {
namespace {

Odometry standingAt(double x) { return {0.0, {x, 0.0, 0.0}, {}, 0.0, 0.0}; }

TEST(GoalTracker, ArrivesOnlyWhenStandingWithinTheTolerance) {
  GoalTracker goal(0.3, 0.2);
  ASSERT_TRUE(goal.set({5.0, 0.0}));
  EXPECT_FALSE(goal.update(standingAt(4.6)));
  Odometry rolling = standingAt(4.9);
  rolling.twist.speed = 0.5;
  EXPECT_FALSE(goal.update(rolling));
  EXPECT_TRUE(goal.update(standingAt(4.8)));
}

TEST(GoalTracker, StaysArrivedUntilPushedBeyondTheHysteresis) {
  GoalTracker goal(0.3, 0.2);
  goal.set({5.0, 0.0});
  goal.update(standingAt(5.0));
  EXPECT_TRUE(goal.update(standingAt(4.55)));
  EXPECT_FALSE(goal.update(standingAt(4.45)));
  EXPECT_FALSE(goal.update(standingAt(4.55)));
}

TEST(GoalTracker, RefusesGoalsThatAreNotFinite) {
  GoalTracker goal(0.3, 0.2);
  EXPECT_FALSE(goal.set({std::numeric_limits<double>::quiet_NaN(), 0.0}));
  EXPECT_FALSE(goal.goal().has_value());
}

TEST(GoalTracker, CancelledOrNewGoalIsNotArrived) {
  GoalTracker goal(0.3, 0.2);
  goal.set({0.0, 0.0});
  EXPECT_TRUE(goal.update(standingAt(0.0)));
  goal.set({3.0, 0.0});
  EXPECT_FALSE(goal.arrived());
  goal.cancel();
  EXPECT_FALSE(goal.update(standingAt(3.0)));
}

}  // namespace
TEST(GoalTracker, CarriedIntoAnotherFrameItIsTheSameGoal) {
  GoalTracker goal(0.3, 0.2);
  goal.carry({1.0, 0.0, 0.0});
  EXPECT_FALSE(goal.goal());
  goal.set({2.0, 0.0});
  EXPECT_TRUE(goal.update({0.0, {2.0, 0.0, 0.0}, {}, 0.0, 0.0}));
  goal.carry({0.3, 0.0, 0.0});
  EXPECT_NEAR(goal.goal()->x(), 2.3, 1e-12);
  EXPECT_TRUE(goal.update({0.1, {2.0, 0.0, 0.0}, {}, 0.0, 0.0})) << "near enough to stay";
  goal.carry({0.0, 0.0, 0.5 * kPi});
  EXPECT_NEAR(goal.goal()->y(), 2.3, 1e-12);
  EXPECT_FALSE(goal.update({0.2, {2.0, 0.0, 0.0}, {}, 0.0, 0.0}));
}

}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

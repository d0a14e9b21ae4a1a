// SPDX-License-Identifier: BSD-3-Clause
#include "motion_history.h"

#include <gtest/gtest.h>

#include <random>

#include "parley_geometry/motion.h"

namespace parley {
namespace {

/// Where a robot on an arc is.
Pose2 onArc(double time) { return integrateTwist({1.0, 2.0, 0.4}, 1.2, 0.8, time); }

TEST(MotionHistory, arcBetweenReadingsWithAndWithoutSpeed) {
  for (const bool has_speed : {true, false}) {
    MotionHistory history;
    for (int i = 0; i <= 5; ++i) history.add({0.3 * i, onArc(0.3 * i), has_speed ? 1.2 : 0.0, 0.8, has_speed});
    for (double time = 0.0; time <= 1.5; time += 0.05) {
      const auto motion = history.at(time);
      ASSERT_TRUE(motion) << time;
      EXPECT_LT((motion->pose.position() - onArc(time).position()).norm(), 2e-3) << time;
      EXPECT_NEAR(angleBetween(onArc(time).yaw, motion->pose.yaw), 0.0, 1e-9);
      EXPECT_NEAR(motion->velocity.norm(), 1.2, has_speed ? 0.02 : 0.1) << time;
    }
  }
}

TEST(MotionHistory, theErrorOfABrakingRobotIsWithinTwoDeviations) {
  MotionHistory history;
  const auto place = [](double t) { return Pose2{2.0 * t - 0.75 * t * t, 0.0, 0.0}; };  // brakes with 1.5 m/s^2
  for (const double t : {0.0, 0.4, 0.8}) history.add({t, place(t), 0.0, 0.0, false});
  for (double t = 0.0; t <= 0.8; t += 0.05) {
    const auto motion = history.at(t);
    ASSERT_TRUE(motion);
    EXPECT_LE(std::abs(motion->pose.x - place(t).x), 2.0 * motion->deviation + 1e-9) << t;
  }
}

TEST(MotionHistory, answersAtItsEndsWhateverTheRounding) {
  MotionHistory history;
  history.add({1.0, onArc(0.0), 0.0, 0.0, false});
  history.add({1.3, onArc(0.3), 0.0, 0.0, false});
  for (const double time : {1.0 - 1e-9, 1.0 + 1e-9, 1.3 - 1e-9, 1.3 + 1e-9}) EXPECT_TRUE(history.at(time)) << time;
  EXPECT_FALSE(history.at(0.9));
  EXPECT_FALSE(history.at(1.4));
}

TEST(MotionHistory, knowsNothingInLongGaps) {
  MotionHistory history;
  history.add({0.0, onArc(0.0), 1.2, 0.8, true});
  history.add({1.5, onArc(1.5), 1.2, 0.8, true});
  EXPECT_FALSE(history.at(0.7));
  EXPECT_TRUE(history.at(1.7));
  EXPECT_FALSE(history.at(1.9));
}

}  // namespace
}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

#include "closed_loop.h"

namespace parley {
namespace {

using testing::ClosedLoop;
using testing::limits;

/// Judges a series of commands by the limits alone.
class LimitsChecker {
 public:
  void add(double time, const Twist2& twist) {
    const MotionLimits l = limits();
    ASSERT_LE(std::abs(twist.speed), l.speed + 1e-9);
    ASSERT_LE(std::abs(twist.turn_rate), l.turn_rate + 1e-9);
    if (known_) {
      const double dt = time - time_;
      ASSERT_LE(std::abs(twist.speed - twist_.speed), l.acceleration * dt + 1e-9);
      ASSERT_LE(std::abs(twist.turn_rate - twist_.turn_rate), l.turn_acceleration * dt + 1e-9);
    }
    known_ = true;
    time_ = time;
    twist_ = twist;
  }

 private:
  bool known_ = false;
  double time_ = 0.0;
  Twist2 twist_;
};

double uniform(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

/// A random walk of twists that no drive with these limits could follow.
SampledTrajectory wildTrajectory(std::mt19937& random, const Pose2& start, double start_time) {
  std::vector<TrajectoryPoint> points{{start_time, start, {}}};
  for (int i = 0; i < 40; ++i) {
    TrajectoryPoint p = points.back();
    p.twist = {uniform(random, -3.0, 3.0), uniform(random, -3.0, 3.0)};
    p.pose = integrateTwist(p.pose, p.twist.speed, p.twist.turn_rate, 0.1);
    p.time += 0.1;
    points.push_back(p);
  }
  return SampledTrajectory(std::move(points));
}

TEST(Limits, holdOnRandomTrajectoriesAndIrregularSteps) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    ClosedLoop loop;
    LimitsChecker checker;
    loop.drive.twist = {uniform(random, -2.0, 2.0), uniform(random, -1.5, 1.5)};
    SampledTrajectory trajectory = wildTrajectory(random, loop.drive.pose, loop.now);
    for (int i = 0; i < 200; ++i) {
      if (i % 50 == 49) trajectory = wildTrajectory(random, loop.drive.pose, loop.now);
      const double now = loop.now;
      checker.add(now, loop.step(trajectory).twist);
      if (HasFatalFailure()) return;
      loop.now += uniform(random, -0.015, 0.03);  // the next call comes early or late
    }
  }
}

TEST(Limits, takesOverAMovingRobotFromItsMeasuredTwist) {
  ClosedLoop loop;
  loop.drive.twist = {1.5, -0.8};
  const ControlResult result = loop.step(SampledTrajectory::standing({}, loop.now));
  EXPECT_NEAR(result.twist.speed, 1.5 - 2.0 * 0.02, 1e-9);
  EXPECT_LT(std::abs(result.twist.turn_rate + 0.8), 3.0 * 0.02 + 1e-9);
}

TEST(Limits, aPauseOfTheCallerDoesNotMakeTheRobotJump) {
  ClosedLoop loop;
  const auto trajectory = testing::trajectoryOf({}, 100.0, 10.0, [](double) { return Twist2{1.0, 0.0}; });
  for (int i = 0; i < 2; ++i) loop.step(trajectory);
  loop.now += 0.4;
  loop.drive.pose.x = 0.4;
  EXPECT_LE(loop.step(trajectory).twist.speed, 0.3);
}

TEST(Limits, badConfigurationIsRefused) {
  ControlOptions options;
  EXPECT_THROW(Controller(options, {}, limits()), std::invalid_argument);
  EXPECT_THROW(Controller(options, testing::footprint(), {}), std::invalid_argument);
  options.damping = -1.0;
  options.period = 9.0;
  try {
    Controller(options, testing::footprint(), limits());
    FAIL();
  } catch (const std::invalid_argument& e) {
    EXPECT_NE(std::string(e.what()).find("damping"), std::string::npos);
    EXPECT_NE(std::string(e.what()).find("period"), std::string::npos);
  }
}

}  // namespace
}  // namespace parley

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

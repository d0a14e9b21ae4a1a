// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "closed_loop.h"

namespace parley {
namespace {

using testing::ClosedLoop;
using testing::trajectoryOf;
using testing::trapezoid;

struct Errors {
  double position = 0.0;  // [m]
  double heading = 0.0;   // [rad]
};

Errors errorsAt(const ClosedLoop& loop, const SampledTrajectory& trajectory) {
  const Pose2 reference = trajectory.at(loop.now).pose;
  return {(reference.position() - loop.drive.pose.position()).norm(), std::abs(angleBetween(reference.yaw, loop.drive.pose.yaw))};
}

/// Drives all of a trajectory and two seconds more; the largest errors from `settled` seconds after its start on.
Errors drive(ClosedLoop& loop, const SampledTrajectory& trajectory, double settled) {
  Errors worst;
  while (loop.now < trajectory.endTime() + 2.0) {
    loop.step(trajectory);
    if (loop.now < trajectory.startTime() + settled) continue;
    const Errors errors = errorsAt(loop, trajectory);
    worst.position = std::max(worst.position, errors.position);
    worst.heading = std::max(worst.heading, errors.heading);
  }
  return worst;
}

struct Case {
  const char* name;
  double duration;   // [s]
  double speed;      // [m/s]
  double turn_rate;  // [rad/s] highest
  int bends;         // 0: one way
};

Twist2 twistOf(const Case& c, double t) {
  const double ramp = trapezoid(t, c.duration, 1.0);
  const double bend = c.bends == 0 ? ramp : std::sin(c.bends * kPi * t / c.duration);
  return {c.speed * ramp, c.turn_rate * bend};
}

class Tracking : public ::testing::TestWithParam<Case> {};

TEST_P(Tracking, staysOnTheReference) {
  const Case c = GetParam();
  ClosedLoop loop;
  const auto trajectory = trajectoryOf({1.0, -2.0, 2.9}, loop.now, c.duration, [&](double t) { return twistOf(c, t); });
  loop.drive.pose = trajectory.points().front().pose;
  const Errors worst = drive(loop, trajectory, 0.0);
  EXPECT_LT(worst.position, 0.02);
  EXPECT_LT(worst.heading, 0.03);
  EXPECT_EQ(loop.drive.twist.speed, 0.0);
  EXPECT_EQ(loop.drive.twist.turn_rate, 0.0);
}

TEST_P(Tracking, comesBackFromAnOffset) {
  const Case c = GetParam();
  std::vector<Pose2> offsets{{0.0, 0.0, 0.3}, {0.0, 0.0, -0.2}};
  if (c.speed != 0.0) {  // turning on the spot takes back no offset to the side
    offsets.insert(offsets.end(), {{-0.1, 0.0, 0.0}, {0.0, 0.1, 0.0}, {0.1, -0.1, -0.3}});
  }
  for (const Pose2& offset : offsets) {
    ClosedLoop loop;
    const auto trajectory = trajectoryOf({}, loop.now, c.duration, [&](double t) { return twistOf(c, t); });
    loop.drive.pose = offset;
    const Errors worst = drive(loop, trajectory, 4.0);
    EXPECT_LT(worst.position, 0.03) << c.name << " from " << offset.x << " " << offset.y << " " << offset.yaw;
    EXPECT_LT(worst.heading, 0.05) << c.name << " from " << offset.x << " " << offset.y << " " << offset.yaw;
  }
}

INSTANTIATE_TEST_SUITE_P(Paths, Tracking,
                         ::testing::Values(Case{"straight", 8.0, 1.8, 0.0, 0}, Case{"arc_left", 8.0, 1.2, 1.0, 0},
                                           Case{"arc_right", 8.0, 1.5, -0.7, 0}, Case{"s", 8.0, 1.5, 0.8, 4},
                                           Case{"reverse", 8.0, -1.0, 0.0, 0}, Case{"reverse_arc", 8.0, -0.8, 0.6, 0},
                                           Case{"reverse_s", 8.0, -1.0, 0.6, 4}, Case{"turn", 6.0, 0.0, 1.2, 0}),
                         [](const auto& instance) { return std::string(instance.param.name); });

TEST(TrackingEnds, turnOnTheSpotTakesBackItsHeading) {
  ClosedLoop loop;
  const auto trajectory = trajectoryOf({}, loop.now, 4.0, [](double t) { return Twist2{0.0, trapezoid(t, 4.0, 0.5)}; });
  loop.drive.pose = {0.0, 0.0, -0.4};
  const Errors worst = drive(loop, trajectory, 4.0);
  EXPECT_LT(worst.heading, 0.03);
  EXPECT_LT(worst.position, 1e-6);
}

TEST(TrackingEnds, forwardsThenBackwardsThroughACusp) {
  ClosedLoop loop;
  const auto trajectory = trajectoryOf({}, loop.now, 8.0, [](double t) {
    return t < 4.0 ? Twist2{trapezoid(t, 4.0, 1.0), 0.3} : Twist2{-trapezoid(t - 4.0, 4.0, 1.0), 0.3};
  });
  const Errors worst = drive(loop, trajectory, 0.5);
  EXPECT_LT(worst.position, 0.03);
}

TEST(TrackingEnds, aDriveThatAnswersLateIsAllowedForByTheLookAhead) {
  ControlOptions options;
  options.look_ahead = 0.01 + 3 * ClosedLoop::kPeriod;
  ClosedLoop loop(options);
  loop.delay_steps = 3;
  const auto trajectory = trajectoryOf({}, loop.now, 8.0, [](double t) {
    return Twist2{1.5 * trapezoid(t, 8.0, 1.0), 0.8 * std::sin(kPi * t / 2.0)};
  });
  const Errors worst = drive(loop, trajectory, 0.0);
  EXPECT_LT(worst.position, 0.06);
  EXPECT_EQ(loop.drive.twist.speed, 0.0);
}

TEST(TrackingEnds, standingRobotHoldsExactlyZeroInNoise) {
  ClosedLoop loop;
  const SampledTrajectory trajectory = SampledTrajectory::standing({}, loop.now);
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, 0.004);
  for (int i = 0; i < 2000; ++i) {
    loop.drive.pose = {noise(random), noise(random), noise(random)};
    loop.drive.twist = {i == 0 ? 0.0 : noise(random), i == 0 ? 0.0 : noise(random)};
    const ControlResult result = loop.step(trajectory);
    ASSERT_EQ(result.twist.speed, 0.0) << "step " << i;
    ASSERT_EQ(result.twist.turn_rate, 0.0) << "step " << i;
  }
}

TEST(TrackingEnds, saysWhyItStandsWhenTheTrajectoryHasEnded) {
  ClosedLoop loop;
  const auto trajectory = trajectoryOf({}, loop.now, 2.0, [](double t) { return Twist2{trapezoid(t, 2.0, 0.5), 0.0}; });
  EXPECT_EQ(loop.step(trajectory).state, DriveState::kDriving);
  drive(loop, trajectory, 0.0);
  const ControlResult result = loop.step(trajectory);
  EXPECT_EQ(result.state, DriveState::kStopped);
  EXPECT_EQ(result.reason, "trajectory has ended");
}

TEST(TrackingEnds, stopsWhenTheRobotIsPushedOffTheTrajectory) {
  ClosedLoop loop;
  const auto trajectory = trajectoryOf({}, loop.now, 8.0, [](double t) { return Twist2{trapezoid(t, 8.0, 1.0), 0.0}; });
  while (loop.now < 103.0) loop.step(trajectory);
  loop.drive.pose.y += 0.7;
  EXPECT_EQ(loop.step(trajectory).state, DriveState::kStopped);
  for (int i = 0; i < 30; ++i) loop.step(trajectory);
  const ControlResult result = loop.step(trajectory);
  EXPECT_EQ(result.twist.speed, 0.0);
  EXPECT_EQ(result.reason.rfind("off the trajectory", 0), 0u) << result.reason;
}

}  // namespace
}  // namespace parley

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "closed_loop.h"

namespace parley {
namespace {

using testing::ClosedLoop;
using testing::trajectoryOf;

/// A robot that drives at 1 m/s on a long left bend, and what it is told next.
struct Moving {
  Moving() : trajectory(bend()), empty() {
    while (loop.now < 102.0) loop.step(trajectory);
    loop.look();
    odometry = {loop.now, loop.drive.pose, loop.drive.twist, 0.0, 0.0};
    request.now = loop.now;
    request.odometry = &odometry;
    request.trajectory = &trajectory;
    request.trajectory_stamp = loop.now;
    request.scan = &loop.scan;
    request.T_odom_scan = loop.T_odom_scan;
  }

  static SampledTrajectory bend() {
    return trajectoryOf({}, 100.0, 20.0, [](double t) {
      return Twist2{testing::trapezoid(t, 20.0, 1.0), 0.5 * testing::trapezoid(t, 20.0, 1.0)};
    });
  }

  ClosedLoop loop;
  SampledTrajectory trajectory;
  SampledTrajectory empty;
  Odometry odometry;
  ControlRequest request;
};

struct Row {
  const char* name;
  std::function<void(Moving&)> fault;
  DriveState state;
  const char* reason;
};

std::vector<Row> rows() {
  using D = DriveState;
  return {
      {"no_odometry_yet", [](Moving& m) { m.request.odometry = nullptr; }, D::kNoOdometry, "no odometry yet"},
      {"old_odometry", [](Moving& m) { m.odometry.stamp -= 0.21; }, D::kNoOdometry, "odometry is 0.21 s old"},
      {"odometry_from_the_future", [](Moving& m) { m.odometry.stamp += 3.0; }, D::kNoOdometry,
       "odometry is 3.00 s ahead of the clock"},
      {"odometry_nan", [](Moving& m) { m.odometry.pose.yaw = std::nan(""); }, D::kNoOdometry, "odometry is not finite"},
      {"twist_inf", [](Moving& m) { m.odometry.twist.speed = INFINITY; }, D::kNoOdometry, "odometry is not finite"},
      {"no_scan_yet", [](Moving& m) { m.request.scan = nullptr; }, D::kNoLidar, "no scan yet"},
      {"old_scan", [](Moving& m) { m.loop.scan.stamp = m.request.now - 0.55; }, D::kNoLidar, "scan is 0.55 s old"},
      {"scan_nan", [](Moving& m) { m.request.T_odom_scan.x = std::nan(""); }, D::kNoLidar, "scan is not finite"},
      {"scan_blind", [](Moving& m) { m.loop.scan.ranges.assign(720, std::nanf("")); }, D::kNoLidar,
       "scan shows nothing, not even free space"},
      {"scan_empty", [](Moving& m) { m.loop.scan.ranges.clear(); }, D::kNoLidar, "scan shows nothing, not even free space"},
      {"planner_silent", [](Moving& m) { m.request.trajectory_stamp -= 0.51; }, D::kStopped, "planner silent"},
      {"planner_stamp_nan", [](Moving& m) { m.request.trajectory_stamp = std::nan(""); }, D::kStopped, "planner silent"},
      {"no_trajectory", [](Moving& m) { m.request.trajectory = &m.empty; }, D::kStopped, "no trajectory"},
      {"null_trajectory", [](Moving& m) { m.request.trajectory = nullptr; }, D::kStopped, "no trajectory"},
      {"clock_nan", [](Moving& m) { m.request.now = std::nan(""); }, D::kStopped, "clock is not finite"},
      {"told_to_stop", [](Moving& m) { m.request.intent = D::kStopped, m.request.intent_reason = "operator"; }, D::kStopped,
       "operator"},
      {"dead", [](Moving& m) { m.request.intent = D::kDead, m.request.intent_reason = "crash"; }, D::kDead, "crash"},
      {"no_route",
       [](Moving& m) {
         m.request.intent = D::kNoRoute, m.request.intent_reason = "closed off";
         m.request.trajectory = &m.empty;
       },
       D::kNoRoute, "closed off"},
  };
}

class Watchdog : public ::testing::TestWithParam<Row> {};

TEST_P(Watchdog, brakesToAStandAndSaysWhy) {
  Moving m;
  GetParam().fault(m);
  const double speed = m.loop.drive.twist.speed;
  ControlResult result = m.loop.controller.step(m.request);
  EXPECT_EQ(result.state, GetParam().state) << toString(result.state);
  EXPECT_EQ(result.reason, GetParam().reason);
  EXPECT_NEAR(result.twist.speed, speed - 0.04, 0.01);
  double last = result.twist.speed;
  for (int i = 0; i < 30; ++i) {
    m.request.now += 0.02;
    result = m.loop.controller.step(m.request);
    EXPECT_LE(result.twist.speed, last);
    last = result.twist.speed;
  }
  EXPECT_EQ(result.twist.speed, 0.0);
  EXPECT_EQ(result.twist.turn_rate, 0.0);
  EXPECT_FALSE(result.emergency);
}

INSTANTIATE_TEST_SUITE_P(Faults, Watchdog, ::testing::ValuesIn(rows()),
                         [](const auto& instance) { return std::string(instance.param.name); });

TEST(WatchdogTolerates, inputsJustYoungEnough) {
  Moving m;
  m.odometry.stamp -= 0.19;
  m.loop.scan.stamp -= 0.49;
  m.request.trajectory_stamp -= 0.49;
  EXPECT_EQ(m.loop.controller.step(m.request).state, DriveState::kDriving);
}

TEST(WatchdogTolerates, intentsOfThePlannerArePassedOn) {
  using D = DriveState;
  for (const D intent : {D::kDriving, D::kWaiting, D::kYielding, D::kEscaping, D::kBlocked}) {
    Moving m;
    m.request.intent = intent;
    m.request.intent_reason = "because";
    const ControlResult result = m.loop.controller.step(m.request);
    EXPECT_EQ(result.state, intent);
    EXPECT_EQ(result.reason, "because");
    EXPECT_GT(result.twist.speed, 0.9);
  }
}

/// Straight, a left bend of half a radian, straight: braking with the bend's curvature would leave the path.
SampledTrajectory kink(double start_time) {
  return trajectoryOf({}, start_time, 12.0, [](double t) {
    return Twist2{2.0 * testing::trapezoid(t, 12.0, 1.0), testing::trapezoid(t - 1.5, 1.0, 0.5)};
  });
}

double distanceFromPath(const SampledTrajectory& path, const Pose2& pose) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < path.points().size(); ++i) {
    least = std::min(
        least, pointSegmentDistance(pose.position(), path.points()[i - 1].pose.position(), path.points()[i].pose.position()));
  }
  return least;
}

TEST(WatchdogBraking, staysOnThePathOfTheLastTrajectory) {
  for (const bool odometry_fails : {false, true}) {
    ClosedLoop loop;
    const SampledTrajectory trajectory = kink(loop.now);
    while (loop.now < 102.0) loop.step(trajectory);
    loop.planner_is_silent = !odometry_fails;
    loop.odometry_is_held = odometry_fails;
    double furthest = 0.0;
    for (int i = 0; i < 80; ++i) {
      loop.step(trajectory);
      furthest = std::max(furthest, distanceFromPath(trajectory, loop.drive.pose));
    }
    EXPECT_EQ(loop.drive.twist.speed, 0.0);
    EXPECT_LT(furthest, 0.02) << "odometry fails: " << odometry_fails;
  }
}

}  // namespace
}  // namespace parley

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

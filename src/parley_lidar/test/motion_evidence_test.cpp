// SPDX-License-Identifier: BSD-3-Clause
// What stands must never be called moving while the robot drives past; what moves must be, soon.
#include <gtest/gtest.h>

#include "parley_lidar/lidar_stage.h"
#include "world.h"

namespace parley::test {
namespace {

constexpr double kStep = 0.005;  // [s] of the recorded drive

/// A drive at up to 2 m/s and 1.57 rad/s that changes its mind every 0.8 s, and what odometry makes of it.
struct Drive {
  std::vector<Odometry> truth, odometry;

  Odometry at(double time) const {
    const std::size_t i = std::min(static_cast<std::size_t>(time / kStep), truth.size() - 2);
    Odometry o = truth[i];
    o.pose = interpolate(truth[i].pose, truth[i + 1].pose, time / kStep - static_cast<double>(i));
    return o;
  }
  bool passesWithin(const Polygon& outline, double distance) const {
    return std::any_of(truth.begin(), truth.end(), [&](const Odometry& o) {
      if (contains(outline, o.pose.position())) return true;
      for (std::size_t i = 0; i < outline.size(); ++i) {
        const Eigen::Vector2d &a = outline[i], &b = outline[(i + 1) % outline.size()];
        if (pointSegmentDistance(o.pose.position(), a, b) < distance) return true;
      }
      return false;
    });
  }
  OdometryBuffer readings(double until) const {
    OdometryBuffer buffer(2.0);
    for (const Odometry& o : odometry) {
      if (o.stamp > until - 1.0 && o.stamp < until + 1e-6) buffer.add(o);
    }
    return buffer;
  }
};

Drive randomDrive(std::mt19937& random, double duration, double slip) {
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  Drive drive;
  Pose2 pose{-5.0 + u(random), -5.0 + u(random), kPi * u(random)}, believed;
  Twist2 twist, wanted;
  const double speed_slip = 1.0 + slip * u(random), turn_slip = 1.0 + slip * u(random);
  for (int i = 0; i * kStep <= duration + 0.2; ++i) {
    if (i % 160 == 0) wanted = {u(random) > -0.3 ? 2.0 : 2.0 * u(random), 1.57 * u(random)};
    if (i % 160 == 0 && pose.position().norm() > 6.5) wanted = {1.0, 1.57};
    twist.speed += std::clamp(wanted.speed - twist.speed, -2.0 * kStep, 2.0 * kStep);
    twist.turn_rate += std::clamp(wanted.turn_rate - twist.turn_rate, -4.0 * kStep, 4.0 * kStep);
    drive.truth.push_back({i * kStep, pose, twist, 0.0, 0.0});
    drive.odometry.push_back({i * kStep, believed, twist, 0.0, 0.0});
    pose = integrateTwist(pose, twist.speed, twist.turn_rate, kStep);
    believed = integrateTwist(believed, twist.speed * speed_slip, twist.turn_rate * turn_slip, kStep);
  }
  return drive;
}

/// Boxes, pillars, parked robots, ends of walls and chairs on thin legs, none in the robot's way.
World randomWorld(std::mt19937& random, const Drive& drive) {
  std::uniform_real_distribution<double> u(-1.0, 1.0), size(0.0, 1.0), place(-7.0, 7.0);
  World world{box({-12.0, -12.0}, {12.0, 12.0}), {}};
  const auto add = [&](const Polygon& outline, const Pose2& pose) {
    if (drive.passesWithin(transformed(pose, outline), 0.47)) return;
    const std::vector<Wall> sides = wallsOf(outline, pose);
    world.walls.insert(world.walls.end(), sides.begin(), sides.end());
  };
  for (int i = 0; i < 14; ++i) {
    const Pose2 pose{place(random), place(random), kPi * u(random)};
    const double a = size(random), b = size(random);
    if (i % 5 == 0) add(rectangle(0.3 + 2.0 * a, 0.04), pose);
    if (i % 5 == 1) add(rectangle(0.3 + 0.4 * a, 0.2 + 0.4 * b), pose);
    if (i % 5 == 2) add(circle(0.1 + 0.2 * a, 8), pose);
    if (i % 5 == 3) add(rectangle(0.8, 0.4), pose);
    for (int leg = 0; i % 5 == 4 && leg < 5; ++leg) {
      const Eigen::Vector2d at = pose.position() + 0.25 * Pose2{0.0, 0.0, leg * 0.4 * kPi}.direction();
      add(circle(0.025, 6), {at.x(), at.y(), 0.0});
    }
  }
  return world;
}

struct Case {
  const char* name;
  int beams;
  double duration;  // [s] of a scan
  double range_max;
  double noise;
  double slip;
};

class StaticWorlds : public testing::TestWithParam<Case> {};

TEST_P(StaticWorlds, NothingMoves) {
  const Case& c = GetParam();
  long followed = 0;
  for (unsigned seed = 0; seed < 12; ++seed) {
    std::mt19937 random(seed);
    const Drive drive = randomDrive(random, 6.0, c.slip);
    const World world = randomWorld(random, drive);
    Lidar lidar;
    lidar.beams = c.beams;
    lidar.duration = c.duration;
    lidar.range_max = c.range_max;
    lidar.noise = c.noise;
    LidarStage stage({}, kRobot, lidar.mount);
    for (double t = 0.2; t < 6.0; t += 0.1) {
      const RangeScan scan = scanned(
          world, [&](double time) { return drive.at(time); }, lidar, t, random);
      const LidarResult result = stage.process(scan, drive.readings(t + c.duration), {});
      ASSERT_TRUE(result.status.is(LidarCode::kOk)) << result.status.text;
      for (const TrackedObject& object : result.tracks) {
        ++followed;
        ASSERT_FALSE(object.moving) << "seed " << seed << " at " << t << " s, " << object.position.transpose();
      }
    }
  }
  EXPECT_GT(followed, 200);
}

INSTANTIATE_TEST_SUITE_P(Lidars, StaticWorlds,
                         testing::Values(Case{"instant", 720, 0.0, 4.0, 0.02, 0.0}, Case{"turning", 720, 0.095, 4.0, 0.02, 0.02},
                                         Case{"noisy_far", 720, 0.0, 10.0, 0.04, 0.02},
                                         Case{"slipping", 720, 0.0, 4.0, 0.02, 0.05}, Case{"coarse", 360, 0.0, 6.0, 0.02, 0.0}),
                         [](const testing::TestParamInfo<Case>& given) { return std::string(given.param.name); });

struct Latencies {
  int judged = 0;
  int late = 0;                 // not called moving within 0.4 s of its first sight
  double worst = 0.0;           // [s]
  double velocity_error = 0.0;  // [m/s] mean
};

/// A robot or a person crosses the view at random; the watcher drives as given.
Latencies watch(const Polygon& outline, double speed, const Twist2& own) {
  Latencies latencies;
  int velocities = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    const double distance = 1.5 + std::abs(u(random)), bearing = kPi * u(random), heading = kPi * u(random);
    const PoseAt other = driving({distance * std::cos(bearing), distance * std::sin(bearing), heading}, speed, 0.0);
    const OdometryAt robot = level(driving({}, own.speed, own.turn_rate));
    bool apart = true;
    for (double t = 0.0; t < 0.8; t += 0.05) apart &= (robot(t).pose.position() - other(t).position()).norm() > 0.9;
    if (!apart) continue;
    ++latencies.judged;
    const World world{box({-9.0, -9.0}, {9.0, 9.0}), {{outline, other}}};
    Lidar lidar;
    lidar.noise = 0.02;
    LidarStage stage({}, kRobot, lidar.mount);
    double moving_since = kInf;
    for (int i = 0; i < 9; ++i) {
      const double t = 0.1 * i;
      const LidarResult result = stage.process(scanned(world, robot, lidar, t, random), recorded(robot, t, t), {});
      for (const TrackedObject& object : result.tracks) {
        if (!object.moving) continue;
        moving_since = std::min(moving_since, t);
        ++velocities;
        latencies.velocity_error += (object.velocity - speed * Pose2{0.0, 0.0, heading}.direction()).norm();
        if (object.stamp < t) continue;  // out of range by now
        const Eigen::Vector2d p_base = robot(t).pose.inverse() * object.position;
        const auto bin = static_cast<std::size_t>((std::atan2(p_base.y(), p_base.x()) + kPi) / (2.0 * kPi) * 720);
        EXPECT_TRUE(result.scan.transient[bin % 720]) << "seed " << seed << " at " << t;
      }
    }
    latencies.late += moving_since > 0.45 ? 1 : 0;
    latencies.worst = std::max(latencies.worst, moving_since);
  }
  latencies.velocity_error /= std::max(1, velocities);
  return latencies;
}

TEST(MovingThings, ARobotIsSeenToMoveWithinFourTenths) {
  for (const double speed : {0.5, 1.0, 2.0}) {
    const Latencies seen = watch(rectangle(0.8, 0.4), speed, {});
    EXPECT_GT(seen.judged, 35);
    EXPECT_EQ(seen.late, 0) << speed << " m/s, worst " << seen.worst;
    EXPECT_LT(seen.velocity_error, 0.15 + 0.1 * speed) << speed;
  }
}

TEST(MovingThings, APersonIsSeenToMoveWithinFourTenths) {
  for (const double speed : {0.5, 1.5}) {
    const Latencies seen = watch(circle(0.22, 12), speed, {});
    EXPECT_EQ(seen.late, 0) << speed << " m/s, worst " << seen.worst;
  }
}

/// From a robot that itself drives and turns, slow things take longer: the side of them that is seen shifts the other way.
TEST(MovingThings, FromADrivingRobotToo) {
  for (const double speed : {1.0, 2.0}) {
    const Latencies seen = watch(rectangle(0.8, 0.4), speed, {2.0, 0.7});
    EXPECT_EQ(seen.late, 0) << speed << " m/s, worst " << seen.worst;
  }
  const Latencies slow = watch(rectangle(0.8, 0.4), 0.5, {2.0, 0.7});
  EXPECT_LT(slow.late, slow.judged / 5) << "worst " << slow.worst;
}

}  // namespace
}  // namespace parley::test

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

// SPDX-License-Identifier: BSD-3-Clause
#include "scan_motion.h"

#include <gtest/gtest.h>

#include "world.h"

namespace parley::test {
namespace {

TEST(ScanMotion, MapsPointsAsHomogeneousTransformsDo) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  for (int round = 0; round < 100; ++round) {
    const double speed = 2.0 * u(random), turn = 1.6 * u(random), roll = 0.3 * u(random), pitch = 0.3 * u(random);
    const Pose2 start{5.0 * u(random), 5.0 * u(random), 3.0 * u(random)};
    const OdometryAt robot = [&](double t) {
      return Odometry{t, integrateTwist(start, speed, turn, t), {speed, turn}, roll * std::cos(t), pitch * std::sin(5.0 * t)};
    };
    const LidarMount mount{0.3 * u(random), 0.3 * u(random), 0.5, 3.0 * u(random)};
    const auto motion = ScanMotion::over(recorded(robot, 0.0, 0.1), 0.0, 0.1, mount);
    ASSERT_TRUE(motion);
    const Odometry end = robot(0.1);
    const Eigen::Isometry3d T_odom_end = attitudeOf({0.1, end.pose, {}, 0.0, 0.0});
    for (const double time : {0.0, 0.02, 0.0503, 0.0999, 0.1}) {
      const Eigen::Vector3d p(3.0 * u(random), 3.0 * u(random), u(random));
      const Eigen::Vector3d exact = T_odom_end.inverse() * attitudeOf(robot(time)) * mountOf(mount) * p;
      const Eigen::Vector3f mapped = motion->at(static_cast<float>(time)) * p.cast<float>();
      EXPECT_NEAR((mapped.cast<double>() - exact).norm(), 0.0, 0.008) << "round " << round << " at " << time;
    }
    const Eigen::Vector3d eye = T_odom_end.inverse() * attitudeOf(end) * mountOf(mount).translation();
    EXPECT_NEAR((motion->origin() - eye.head<2>()).norm(), 0.0, 1e-6);
  }
}

TEST(ScanMotion, StillOnlyIfInstantaneousAndLevel) {
  const OdometryBuffer level_buffer = recorded(level(driving({}, 1.0, 0.0)), 0.0, 0.1);
  EXPECT_TRUE(ScanMotion::over(level_buffer, 0.0, 0.0, {})->isStill());
  EXPECT_EQ(ScanMotion::over(level_buffer, 0.0, 0.0, {})->travel(), 0.0);
  EXPECT_FALSE(ScanMotion::over(level_buffer, 0.0, 0.1, {})->isStill());
  EXPECT_NEAR(ScanMotion::over(level_buffer, 0.0, 0.1, {})->travel(), 0.1, 1e-6);
  const OdometryAt tilted = [](double t) { return Odometry{t, {}, {}, 0.01, 0.0}; };
  EXPECT_FALSE(ScanMotion::over(recorded(tilted, 0.0, 0.1), 0.0, 0.0, {})->isStill());
}

TEST(ScanMotion, NeedsOdometryForAllOfTheScan) {
  const OdometryBuffer buffer = recorded(level(standing(0.0, 0.0)), 1.0, 1.0);
  EXPECT_TRUE(ScanMotion::over(buffer, 1.0, 0.05, {})) << "extrapolated";
  EXPECT_FALSE(ScanMotion::over(buffer, 1.0, 0.5, {}));
  EXPECT_FALSE(ScanMotion::over(buffer, 0.0, 0.1, {}));
  EXPECT_FALSE(ScanMotion::over(OdometryBuffer(), 1.0, 0.0, {}));
}

}  // namespace
}  // namespace parley::test

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

// SPDX-License-Identifier: BSD-3-Clause
#include "parley_geometry/spatial_odometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace parley {
namespace {

const MotionLimits kLimits{2.0, 1.5708, 2.0, 4.0};

Eigen::Isometry3d transform(const Eigen::Vector3d& position, double roll, double pitch, double yaw) {
  Eigen::Isometry3d t = Eigen::Isometry3d::Identity();
  t.translation() = position;
  t.linear() = (Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
                Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()))
                   .toRotationMatrix();
  return t;
}

/// What lidar odometry says of a base at a pose: its frame is where the sensor was at the start.
Eigen::Isometry3d seen(const Eigen::Isometry3d& T_base_sensor, const Eigen::Isometry3d& T_odom_base) {
  return T_base_sensor.inverse() * T_odom_base * T_base_sensor;
}

TEST(SpatialOdometry, isOfTheBaseHoweverTheSensorIsMounted) {
  for (const double tilt : {0.0, 0.4}) {
    const Eigen::Isometry3d mount = transform({0.3, -0.1, 0.6}, tilt, -tilt, 2.0);
    SpatialOdometry odometry(mount, TwistOptions{}, kLimits);
    Pose2 truth;
    for (int i = 0; i <= 60; ++i) {
      const double time = 50.0 + 0.05 * i;
      const auto found = odometry.add(time, seen(mount, transform({truth.x, truth.y, 0.0}, 0.0, 0.0, truth.yaw)));
      ASSERT_EQ(found.has_value(), i > 0);
      if (found) {
        ASSERT_EQ(found->stamp, time);
        ASSERT_NEAR((found->pose.position() - truth.position()).norm(), 0.0, 1e-9);
        ASSERT_NEAR(angleBetween(found->pose.yaw, truth.yaw), 0.0, 1e-9);
        ASSERT_NEAR(found->roll, 0.0, 1e-9);
        ASSERT_NEAR(found->pitch, 0.0, 1e-9);
        ASSERT_NEAR(found->twist.speed, 1.0, 0.01);
        ASSERT_NEAR(found->twist.turn_rate, 1.2, 0.02);
      }
      truth = integrateTwist(truth, 1.0, 1.2, 0.05);
    }
  }
}

TEST(SpatialOdometry, turningOnTheSpotIsNoDriving) {
  const Eigen::Isometry3d mount = transform({0.4, 0.0, 0.5}, 0.0, 0.0, 0.0);
  SpatialOdometry odometry(mount, TwistOptions{}, kLimits);
  for (int i = 0; i < 100; ++i) {
    const auto found = odometry.add(0.05 * i, seen(mount, transform({0.0, 0.0, 0.0}, 0.0, 0.0, 0.05 * i)));
    if (!found) continue;
    ASSERT_NEAR(found->twist.speed, 0.0, 1e-6);
    ASSERT_NEAR(found->twist.turn_rate, 1.0, 0.02);
  }
}

TEST(SpatialOdometry, keepsTheAttitude) {
  const Eigen::Isometry3d mount = transform({0.2, 0.1, 0.5}, 0.0, 0.0, 0.7);
  SpatialOdometry odometry(mount, TwistOptions{}, kLimits);
  odometry.add(1.0, seen(mount, Eigen::Isometry3d::Identity()));
  const auto found = odometry.add(1.05, seen(mount, transform({0.02, 0.0, 0.01}, 0.03, -0.05, 0.01)));
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->roll, 0.03, 1e-9);
  EXPECT_NEAR(found->pitch, -0.05, 1e-9);
  EXPECT_NEAR(found->pose.yaw, 0.01, 1e-9);
}

TEST(SpatialOdometry, dropsWhatIsLateRepeatedOrNoPose) {
  SpatialOdometry odometry(Eigen::Isometry3d::Identity(), TwistOptions{}, kLimits);
  const Eigen::Isometry3d still = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d none = still;
  none.translation().x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(odometry.add(10.0, still));
  EXPECT_TRUE(odometry.add(10.1, still));
  EXPECT_FALSE(odometry.add(10.1, still));
  EXPECT_FALSE(odometry.add(9.5, still));
  EXPECT_FALSE(odometry.add(10.2, none));
  EXPECT_FALSE(odometry.add(std::numeric_limits<double>::infinity(), still));
  EXPECT_EQ(odometry.dropped(), 4);
  EXPECT_TRUE(odometry.add(10.2, still));
}

TEST(SpatialOdometry, startsAgainWhereTimeDoes) {
  SpatialOdometry odometry(Eigen::Isometry3d::Identity(), TwistOptions{}, kLimits);
  const Eigen::Isometry3d still = Eigen::Isometry3d::Identity();
  odometry.add(10.0, still);
  EXPECT_TRUE(odometry.add(10.1, still));
  EXPECT_FALSE(odometry.add(2.0, still)) << "the velocity is not known";
  EXPECT_TRUE(odometry.add(2.1, still));
  EXPECT_EQ(odometry.dropped(), 0);
}

}  // namespace
}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

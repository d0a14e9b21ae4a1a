// SPDX-License-Identifier: BSD-3-Clause
#include "parley_geometry/odometry_buffer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace parley {
namespace {

/// A robot on a circle, turning through the wrap of its heading.
Odometry onCircle(double time) {
  Odometry o;
  o.stamp = time;
  o.twist = {1.0, 0.8};
  o.pose = integrateTwist({0.0, 0.0, 2.5}, o.twist.speed, o.twist.turn_rate, time);
  o.roll = 0.01 * time;
  o.pitch = -0.02 * time;
  return o;
}

OdometryBuffer filled(double from, double to, double step) {
  OdometryBuffer buffer;
  for (double t = from; t <= to + 1e-9; t += step) buffer.add(onCircle(t));
  return buffer;
}

TEST(OdometryBuffer, interpolatesBetweenReadings) {
  const OdometryBuffer buffer = filled(0.0, 1.5, 0.05);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> time(0.0, 1.5);
  for (int i = 0; i < 2000; ++i) {
    const double t = time(random);
    const auto o = buffer.at(t);
    ASSERT_TRUE(o) << t;
    const Odometry truth = onCircle(t);
    ASSERT_EQ(o->stamp, t);
    ASSERT_LT((o->pose.position() - truth.pose.position()).norm(), 3e-4) << t;  // the arc's height over its chord
    ASSERT_NEAR(angleBetween(truth.pose.yaw, o->pose.yaw), 0.0, 1e-9) << t;
    ASSERT_NEAR(o->roll, truth.roll, 1e-9);
    ASSERT_NEAR(o->pitch, truth.pitch, 1e-9);
    ASSERT_NEAR(o->twist.turn_rate, 0.8, 1e-9);
  }
}

TEST(OdometryBuffer, givesReadingsAsTheyAre) {
  const OdometryBuffer buffer = filled(0.0, 1.0, 0.25);
  for (const double t : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    ASSERT_TRUE(buffer.at(t)) << t;
    EXPECT_TRUE(buffer.at(t)->pose == onCircle(t).pose) << t;
  }
}

TEST(OdometryBuffer, goesATenthOfASecondAhead) {
  const OdometryBuffer buffer = filled(0.0, 1.0, 0.25);
  const auto ahead = buffer.at(1.08);
  ASSERT_TRUE(ahead);
  EXPECT_LT((ahead->pose.position() - onCircle(1.08).pose.position()).norm(), 1e-9);
  EXPECT_EQ(ahead->stamp, 1.08);
  EXPECT_FALSE(buffer.at(1.11));
  EXPECT_FALSE(buffer.at(-0.01));
  EXPECT_FALSE(buffer.at(NAN));
  EXPECT_FALSE(buffer.at(INFINITY));
}

TEST(OdometryBuffer, startsEmptyAndCanBeCleared) {
  OdometryBuffer buffer;
  EXPECT_TRUE(buffer.empty());
  EXPECT_FALSE(buffer.at(0.0));
  EXPECT_EQ(buffer.add(onCircle(3.0)), OdometryVerdict::kAccepted);
  EXPECT_EQ(buffer.latest().stamp, 3.0);
  EXPECT_TRUE(buffer.at(3.0));
  buffer.clear();
  EXPECT_TRUE(buffer.empty());
}

TEST(OdometryBuffer, refusesWhatIsNotFinite) {
  OdometryBuffer buffer;
  for (int field = 0; field < 8; ++field) {
    Odometry o = onCircle(1.0);
    double* const fields[] = {&o.stamp, &o.pose.x, &o.pose.y, &o.pose.yaw, &o.twist.speed, &o.twist.turn_rate, &o.roll, &o.pitch};
    *fields[field] = field % 2 == 0 ? NAN : INFINITY;
    EXPECT_EQ(buffer.add(o), OdometryVerdict::kNotFinite) << field;
  }
  EXPECT_TRUE(buffer.empty());
}

TEST(OdometryBuffer, dropsWhatComesLateAndStartsAgainWhenTimeWentBack) {
  OdometryBuffer buffer = filled(10.0, 11.0, 0.25);
  EXPECT_EQ(buffer.add(onCircle(11.0)), OdometryVerdict::kOutOfOrder);
  EXPECT_EQ(buffer.add(onCircle(10.5)), OdometryVerdict::kOutOfOrder);
  EXPECT_EQ(buffer.latest().stamp, 11.0);
  EXPECT_EQ(buffer.add(onCircle(5.0)), OdometryVerdict::kTimeWentBack);
  EXPECT_EQ(buffer.latest().stamp, 5.0);
  EXPECT_FALSE(buffer.at(10.5));
}

TEST(OdometryBuffer, aJumpForgetsWhatWasBefore) {
  for (const Pose2& jump : {Pose2{1.2, 0.0, 0.0}, Pose2{0.0, 0.0, 1.2}}) {
    OdometryBuffer buffer = filled(0.0, 1.0, 0.25);
    Odometry o = onCircle(1.05);
    o.pose = o.pose * jump;
    EXPECT_EQ(buffer.add(o), OdometryVerdict::kJumped);
    EXPECT_FALSE(buffer.at(1.0));
    EXPECT_TRUE(buffer.at(1.05));
  }
}

TEST(OdometryBuffer, aLongSilenceIsNoJump) {
  OdometryBuffer buffer = filled(0.0, 1.0, 0.25);
  Odometry o = onCircle(2.5);
  o.pose.x += 3.0;
  EXPECT_EQ(buffer.add(o), OdometryVerdict::kAccepted);
}

TEST(OdometryBuffer, keepsTheHorizonAndTheCapacity) {
  OdometryBuffer by_time(1.0, 1000);
  OdometryBuffer by_count(100.0, 5);
  for (int i = 0; i <= 100; ++i) {
    by_time.add(onCircle(0.05 * i));
    by_count.add(onCircle(0.05 * i));
  }
  EXPECT_TRUE(by_time.at(4.01));
  EXPECT_FALSE(by_time.at(3.94));
  EXPECT_TRUE(by_count.at(4.81));
  EXPECT_FALSE(by_count.at(4.79));
}

}  // namespace
}  // namespace parley

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
